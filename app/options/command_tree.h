// SPDX-License-Identifier: BSD-3-Clause
// The options of every command as plain data, read from their declarations, for help, manual pages and completion.
#pragma once

#include <string>
#include <vector>

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

}  // namespace meniscus
