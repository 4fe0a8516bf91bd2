// SPDX-License-Identifier: BSD-3-Clause
// Reads the declared options out of CLI11.
#include "app/options/command_tree.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <CLI/CLI.hpp>

#include "core/properties/properties.h"

namespace meniscus {
namespace {

/// Those that the checks of an option name: see one_of() and proposes() in app/options/property_options.h.
std::vector<std::string> words_of(const CLI::Option& option) {
  std::vector<std::string> words;
  try {
    for (int n = 0;; ++n) {
      const std::string& name = const_cast<CLI::Option&>(option).get_validator(n)->get_name();
      if (!name.empty()) words = CLI::detail::split(name, '|');
    }
  } catch (const CLI::OptionNotFound&) {
    return words;  // there are no more checks
  }
}

OptionEntry entry_of(const CLI::Option& option) {
  OptionEntry entry;
  if (option.get_positional()) entry.names.push_back(option.get_name(true));
  for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
  if (option.get_expected_max() > 0 && !option.get_positional()) entry.value = option.get_type_name();
  entry.description = option.get_description();
  entry.required = option.get_required();
  entry.value_optional = option.get_expected_min() == 0;
  entry.words = words_of(option);
  return entry;
}

/// Files that options and arguments outside of the property table name.
bool names_path(std::string_view word) {
  constexpr std::array<std::string_view, 6> kPaths{"FILE", "FOLDER", "BUNDLE", "DIR", "INTO", "FROM"};
  return std::ranges::any_of(kPaths, [&](std::string_view path) { return word.starts_with(path); });
}

void read_options(const CLI::App& app, CommandEntry& command) {
  for (const std::string& title : app.get_groups()) {
    OptionSection section{title, {}};
    for (const CLI::Option* option : app.get_options()) {
      if (title.empty() || option->get_group() != title) continue;
      (option->get_positional() ? command.arguments : section.options).push_back(entry_of(*option));
    }
    if (!section.options.empty()) command.sections.push_back(std::move(section));
  }
}

CommandEntry read_command(const CLI::App& app, const std::string& parent) {
  CommandEntry command;
  command.name = app.get_name();
  command.path = parent.empty() ? command.name : parent + " " + command.name;
  command.summary = app.get_description();
  command.footer = app.get_footer();
  read_options(app, command);
  for (const CLI::App* below : app.get_subcommands({})) command.commands.push_back(read_command(*below, command.path));
  return command;
}

}  // namespace

bool OptionEntry::takes_path() const {
  const auto is_path_of = [&](const Property* property) {
    using enum ValueType;
    return (property->type == file || property->type == new_file || property->type == camera) &&
           std::ranges::find(names, property->long_option()) != names.end();
  };
  return std::ranges::any_of(properties(), is_path_of) ||
         names_path(value.empty() && !names.empty() ? std::string_view(names.front()) : value);
}

bool takes_path(const CLI::Option& option) { return entry_of(option).takes_path(); }

CommandEntry command_tree(const CLI::App& program) { return read_command(program, ""); }

std::vector<const CommandEntry*> all_commands(const CommandEntry& tree) {
  std::vector<const CommandEntry*> all{&tree};
  for (const CommandEntry& below : tree.commands)
    for (const CommandEntry* command : all_commands(below)) all.push_back(command);
  return all;
}

}  // namespace meniscus
