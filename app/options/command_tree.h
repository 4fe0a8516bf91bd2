// SPDX-License-Identifier: BSD-3-Clause
// The options of every command as plain data, and messages about unknown options.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace meniscus {

/// An option or an argument.
struct OptionEntry {
  std::vector<std::string> names;  ///< "-o", "--output"; for an argument, its name in capitals
  std::string value;               ///< the name of its value; empty if it takes none
  std::string description;
  bool required = false;
  bool value_optional = false;     ///< true if its value may be left out
  std::vector<std::string> words;  ///< values to propose; empty if values are not words

  /// Returns true if the value is a path.
  bool takes_path() const;
};

/// The options under one heading of the help.
struct OptionSection {
  std::string title;
  std::vector<OptionEntry> options;
};

/// A command and its subcommands.
struct CommandEntry {
  std::string name;     ///< the word that users type: "meniscus", "export", "povray"
  std::string path;     ///< all words: "meniscus export povray"
  std::string summary;  ///< one line
  std::string footer;   ///< examples, and further explanations
  std::vector<OptionEntry> arguments;
  std::vector<OptionSection> sections;
  std::vector<CommandEntry> commands;
};

/// Returns true if the values of an option are paths.
bool takes_path(const CLI::Option& option);

/// Returns the entry of the program with everything below it.
CommandEntry command_tree(const CLI::App& program);

/// Returns `tree` and all entries below it, parents first.
std::vector<const CommandEntry*> all_commands(const CommandEntry& tree);

/// Makes the last value count if an option that has one value is given several times, in this command and in commands
/// that are added to it later.
void let_the_last_count(CLI::App& program);

/// Returns the command whose options were being read when parsing ended: the innermost one on the command line.
const CLI::App& named_command(const CLI::App& program);

/// Returns the names of a command and of its parents: "meniscus render".
std::string command_path(const CLI::App& command);

/// Returns the sentence about words that the command on the command line does not know: the first of them in the order
/// of the command line, and the option that was probably meant, by its letters or by its name in other programs.
std::string unknown_option_fault(const CLI::App& program, std::span<const char* const> words);

/// Returns "; did you mean X?" for the option of the command that the word probably means; else empty.
std::string meant_option(const CLI::App& command, std::string_view word);

}  // namespace meniscus
