// SPDX-License-Identifier: BSD-3-Clause
// Scene files: all of a figure in one JSON file, which stands for the options of a command line.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/base/output_file.h"

namespace meniscus {

/// A command line in which the words of a scene stand for --scene FILE.
struct SceneWords {
  std::vector<std::string> words;           ///< without the program
  std::string file;                         ///< of the scene; empty: there is none
  std::map<std::string, std::string> keys;  ///< of the options that the scene gave and the command line did not

  /// Names the file and its key if a message begins with the option that came from there.
  std::string name_key(const std::string& message) const;
};

/// Replaces --scene FILE by what the file says, in front of what else was typed, so that this counts. `file`: JSON as
/// docs/scenes.md describes it, or a picture that holds it. A command leaves out what it has no options for; what would
/// change what an export shows it refuses. Scenes may come from anybody: without --trust-scene they name no files
/// outside of their folder but those that are typed or in `named`, and write to none but a new one beside them. Throws
/// InputError for a file that is no scene or names such files, UsageError.
SceneWords with_scene(const CLI::App& program, std::vector<std::string> words,
                      const std::vector<std::string>& named = {});

/// --scene, for the help; and --save-scene where `save_path` is given, which must live as long as the command.
void add_scene_options(CLI::App& command, std::string* save_path = nullptr);

/// The file of --save-scene.
class SceneOutput {
 public:
  /// path: empty if none is wanted. Fails before any work is done if it cannot be written: throws OutputError,
  /// UsageError for a molecule from standard input.
  SceneOutput(const CLI::App& command, const std::string& path, Existing existing);
  /// Once the work is done.
  void commit();

 private:
  std::optional<OutputFile> file_;
};

/// The scene that the words of a parsed command describe. folder: which paths are written as seen from; empty: by their
/// names alone, and without that of the output.
std::string scene_text(const CLI::App& command, const std::string& folder);

}  // namespace meniscus
