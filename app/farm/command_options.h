// SPDX-License-Identifier: BSD-3-Clause
// The options that a bundled command may have: a list of harmless ones, with the kinds of their values.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace meniscus::farm {

/// An option of a bundled command as it was understood.
struct CommandOption {
  std::string name;                  ///< "--camera"
  std::optional<std::string> value;  ///< several values with commas between
  bool reads_file = false;           ///< the value is the path of a file to read
  std::size_t place = 0;             ///< of the word, among those read, that has the value, or of the name
  bool joined = false;               ///< that word is name=value
};

/// Reads what is after FILE. Every word must be a known option or its value: nothing that writes a file, starts a
/// program, or is merely unknown gets through. Throws RequestError for anything else.
std::vector<CommandOption> read_command_options(const std::vector<std::string>& words);

/// One word an option, "--name=value": the same to every parser.
std::vector<std::string> as_words(const std::vector<CommandOption>& options);

/// Options that say where and with how much this program computes: --device, --threads, --require-gpu, --jobs. Throws
/// RequestError for others.
std::vector<CommandOption> read_device_options(const std::vector<std::string>& words);

/// Throws RequestError unless all are options of POV-Ray that change how the scene of the bundle looks, and nothing
/// else: no files, no programs, no other scene.
void check_povray_options(const std::vector<std::string>& words);

/// The same for the options of Blender's driver.
void check_blender_options(const std::vector<std::string>& words);

}  // namespace meniscus::farm
