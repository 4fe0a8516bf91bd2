// SPDX-License-Identifier: BSD-3-Clause
// Finds the option that was probably meant.
#include "app/options/usage_faults.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "core/base/text.h"

namespace meniscus {
namespace {

/// A word of other programs, and our options for it, the best first.
struct ForeignWord {
  std::string_view word;
  std::array<std::string_view, 3> options;
};

// Of PyMOL, ChimeraX, VMD, POV-Ray, Blender, ffmpeg and ImageMagick.
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
  // The beginning of one option alone, or a few letters off.
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
