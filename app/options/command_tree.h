// SPDX-License-Identifier: BSD-3-Clause
// The options of every command as plain data, and messages about options that were not understood.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace meniscus {

/// An option or an argument.
struct OptionEntry {
  std::vector<std::string> names;  ///< "-o", "--output"; of an argument its name in capitals
  std::string value;               ///< the word for its value; empty if it takes none
  std::string description;
  bool required = false;
  bool value_optional = false;     ///< may have no value
  std::vector<std::string> words;  ///< values to propose; empty if they are not words

  /// Whether the value is a path.
  bool takes_path() const;
};

/// Options under one heading of the help.
struct OptionSection {
  std::string title;
  std::vector<OptionEntry> options;
};

/// A command, and those below it.
struct CommandEntry {
  std::string name;     ///< the word that was typed: "meniscus", "export", "povray"
  std::string path;     ///< all words: "meniscus export povray"
  std::string summary;  ///< one line
  std::string footer;   ///< examples, and what else a reader should know
  std::vector<OptionEntry> arguments;
  std::vector<OptionSection> sections;
  std::vector<CommandEntry> commands;
};

/// Whether the values of an option are paths.
bool takes_path(const CLI::Option& option);

/// Of the program with all that was added to it.
CommandEntry command_tree(const CLI::App& program);

/// `tree` and all below it, parents first.
std::vector<const CommandEntry*> all_commands(const CommandEntry& tree);

/// From now on the last of an option that may be given once counts, in this command and those added to it later.
void let_the_last_count(CLI::App& program);

/// The command whose options were being read when parsing ended: the innermost of those that were named.
const CLI::App& named_command(const CLI::App& program);

/// "meniscus render", for that of a program.
std::string command_path(const CLI::App& command);

/// The sentence for words that the named command does not know: the first of them in the order they were typed, and the
/// option that was meant, by its letters or by what other programs call it.
std::string unknown_option_fault(const CLI::App& program, std::span<const char* const> words);

/// "; did you mean X?" for the option of the command that a word may mean; else empty.
std::string meant_option(const CLI::App& command, std::string_view word);

}  // namespace meniscus
