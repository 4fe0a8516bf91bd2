// SPDX-License-Identifier: BSD-3-Clause
// Reads the declared options out of CLI11, and finds the option that was probably meant.
#include "app/options/command_tree.h"

#include <algorithm>
#include <array>
#include <utility>

#include <CLI/CLI.hpp>

#include "core/base/text.h"
#include "core/properties/properties.h"

namespace meniscus {
namespace {

/// Returns the words in the names of an option's checks: see one_of() and proposes() in app/options/property_options.h.
std::vector<std::string> words_of(const CLI::Option& option) {
  std::vector<std::string> words;
  try {
    for (int n = 0;; ++n) {
      const std::string& name = const_cast<CLI::Option&>(option).get_validator(n)->get_name();
      if (!name.empty()) words = CLI::detail::split(name, '|');
    }
  } catch (const CLI::OptionNotFound&) {
    return words;  // thrown when there are no more checks
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

/// Returns true if the name of a value, such as FILE, is that of a path, for options outside of the property table.
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

namespace {

/// A word of another program, and the options that it may mean here, the best first.
struct ForeignWord {
  std::string_view word;
  std::array<std::string_view, 3> options;
};

// The words are from PyMOL, ChimeraX, VMD, POV-Ray, Blender, ffmpeg and ImageMagick.
constexpr std::array<ForeignWord, 48> kForeignWords{{
    {"--colour", {"--color"}},
    {"--colors", {"--color"}},
    {"--color-by", {"--color"}},
    {"--bg", {"--background"}},
    {"--bg-color", {"--background"}},
    {"--bgcolor", {"--background"}},
    {"--bg-colour", {"--background"}},
    {"--transparent", {"--background"}},
    {"--ao", {"--ambient-occlusion"}},
    {"--occlusion", {"--ambient-occlusion"}},
    {"--shadow", {"--shadows", "--ambient-occlusion"}},
    {"--outline", {"--silhouettes"}},
    {"--outlines", {"--silhouettes"}},
    {"--silhouette", {"--silhouettes"}},
    {"--fog", {"--depth-cue"}},
    {"--resolution", {"--dpi", "--size"}},
    {"--units", {"--width", "--size"}},
    {"--geometry", {"--size"}},
    {"--zoom", {"--zoom-to"}},
    {"--focus", {"--zoom-to"}},
    {"--orient", {"--view"}},
    {"--rotate", {"--turn", "--view"}},
    {"--rot", {"--turn", "--view"}},
    {"--spin", {"--turntable", "--turn"}},
    {"--ortho", {"--projection"}},
    {"--orthographic", {"--projection"}},
    {"--perspective", {"--projection"}},
    {"--ray", {"--size"}},
    {"--png", {"--output"}},
    {"--antialias", {"--samples"}},
    {"--aa", {"--samples"}},
    {"--transparency", {"--opacity"}},
    {"--alpha", {"--opacity", "--background"}},
    {"--slab", {"--clip"}},
    {"--cut", {"--clip"}},
    {"--cartoon", {"--tube"}},
    {"--ribbon", {"--tube"}},
    {"--licorice", {"--sticks"}},
    {"--nucleotides", {"--bases"}},
    {"--ladder", {"--bases"}},
    {"--snfg", {"--glycans", "--color"}},
    {"--probe-radius", {"--probe"}},
    {"--solvent-radius", {"--probe"}},
    {"--palette", {"--map"}},
    {"--colormap", {"--map"}},
    {"--range", {"--color-range"}},
    {"--out", {"--output"}},
    {"--overwrite", {"--force"}},
}};

std::vector<std::string> names_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

}  // namespace

void let_the_last_count(CLI::App& program) {
  program.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

const CLI::App& named_command(const CLI::App& program) {
  const std::vector<CLI::App*> below = const_cast<CLI::App&>(program).get_subcommands();
  return below.empty() ? program : named_command(*below.back());
}

std::string command_path(const CLI::App& command) {
  return command.get_parent() ? command_path(*command.get_parent()) + " " + command.get_name() : command.get_name();
}

std::string meant_option(const CLI::App& command, std::string_view word) {
  const std::vector<std::string> names = names_of(command);
  const auto foreign = std::ranges::find(kForeignWords, word, &ForeignWord::word);
  if (foreign != kForeignWords.end())
    for (const std::string_view option : foreign->options)
      if (std::ranges::find(names, option) != names.end()) return fmt::format("; did you mean {}?", option);
  // The word may be the beginning of exactly one option, or differ from one by a few letters.
  const auto begins = [&](const std::string& name) { return word.size() > 4 && name.starts_with(word); };
  if (std::ranges::count_if(names, begins) == 1)
    return fmt::format("; did you mean {}?", *std::ranges::find_if(names, begins));
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string_view nearest = word.starts_with("--") ? nearest_word(word, known) : std::string_view();
  return nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest);
}

std::string unknown_option_fault(const CLI::App& program, std::span<const char* const> words) {
  const CLI::App& command = named_command(program);
  const std::vector<std::string> left = program.remaining(true);
  for (const char* const word : words) {
    if (std::ranges::find(left, std::string(word)) == left.end()) continue;
    const std::string_view name = std::string_view(word).substr(0, std::string_view(word).find('='));
    if (!name.starts_with('-') || name == "-")
      return fmt::format("{} is one argument too many for {}", in_quotes(word), command_path(command));
    return fmt::format("{} has no option {}{}", command_path(command), in_quotes(name), meant_option(command, name));
  }
  return "there are too many words";
}

}  // namespace meniscus
