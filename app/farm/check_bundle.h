// SPDX-License-Identifier: BSD-3-Clause
// Reads bundles, and checks that everything they ask for stays in their folders: they may come from anywhere.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/farm/bundle.h"

namespace meniscus::farm {

/// Reads DIR/bundle.json. Throws InputError: missing, damaged, of another schema, or what check_bundle refuses.
Bundle read_bundle(const std::filesystem::path& folder);

/// Of a command, such as {"render"} or {"export", "povray"}: its steps in order, without arguments. Throws RequestError
/// for a command that cannot be bundled.
std::vector<Step> steps_of(const std::vector<std::string>& words);

/// Throws RequestError unless: the command is a framed one whose options are all known to be harmless, and whose files
/// are inputs of the bundle; inputs, steps, film and numbers are such as this program makes.
void check_bundle(const Bundle& bundle);

/// The command as it is run, by words that cannot be understood in two ways: {"render", "inputs/a.pdb",
/// "--probe=1.2", ...}. Inputs by reference have their real paths if the bundle's folder is given. Throws RequestError
/// as check_bundle does.
std::vector<std::string> checked_command(const Bundle& bundle, const std::filesystem::path& folder = {});

/// Where an input is read: in the bundle's folder, or where it is by reference if it is not in there.
std::filesystem::path input_path(const Input& input, const std::filesystem::path& folder);

/// Of {"render", "FILE", ...} 1, of {"export", "povray", "FILE", ...} 2: words before FILE.
std::size_t command_word_count(const std::vector<std::string>& command);

}  // namespace meniscus::farm
