// SPDX-License-Identifier: BSD-3-Clause
// Parses a command twice: by its own options, to check it, and by the shared ones, to know its molecule and its run.
#include "app/commands/parse_bundled_command.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/farm/bundled_steps.h"
#include "app/farm/command_options.h"
#include "app/process/program_error.h"
#include "app/options/figure_options.h"
#include "app/options/picture_options.h"
#include "app/options/scene_file.h"
#include "app/options/usage_faults.h"
#include "core/base/text.h"

namespace meniscus::farm {
namespace {

using Words = std::vector<std::string>;

const std::set<std::string> kDecidedByBundle{"-o", "--output", "--force", "--only", "--progress", "--save-camera"};
// How many words the value has.
const std::map<std::string, std::size_t> kDeviceOptions{
    {"--device", 1}, {"--threads", 1}, {"--require-gpu", 0}, {"--jobs", 1}};

std::string option_name(const std::string& word) { return word.substr(0, word.find('=')); }

void split(const Words& words, BundledCommand& result) {
  if (words.empty()) throw UsageError("no command behind --; such as: -- render FILE --frames all");
  const std::size_t word_count = words.front() == "export" ? 2 : 1;
  if (words.size() <= word_count) throw UsageError("behind -- there is no FILE");
  const auto behind = words.begin() + static_cast<std::ptrdiff_t>(word_count);
  result.words.assign(words.begin(), behind);
  const std::vector<Step> steps = steps_of(result.words);
  if (behind->starts_with('-')) {
    throw UsageError(fmt::format("name FILE right behind {}, then options; standard input cannot be bundled",
                                 fmt::join(result.words, " ")));
  }
  const auto second = std::find(behind, words.end(), "--");
  result.arguments.assign(behind, second);
  if (second != words.end()) result.renderer.assign(second + 1, words.end());
  if (!result.renderer.empty() && steps.back().maker == Maker::meniscus)
    throw UsageError(fmt::format("no renderer is started for {}; leave out what is behind the second --",
                                 fmt::join(result.words, " ")));
}

void take_out_device(BundledCommand& result) {
  Words left;
  for (std::size_t n = 0; n < result.arguments.size(); ++n) {
    const std::string& word = result.arguments[n];
    const auto option = kDeviceOptions.find(option_name(word));
    const bool has_value = word.find('=') != std::string::npos;
    if (option == kDeviceOptions.end()) {
      left.push_back(word);
      continue;
    }
    const std::size_t values = has_value ? 0 : option->second;
    for (std::size_t m = 0; m <= values && n + m < result.arguments.size(); ++m)
      result.device.push_back(result.arguments[n + m]);
    n += values;
  }
  result.arguments = left;
}

/// The command of this name with all its options.
void add_command(CLI::App& program, const Words& words) {
  const Command table[] = {{"render", add_render},
                           {"povray", add_export_povray},
                           {"blender", add_export_blender},
                           {"mitsuba", add_export_mitsuba},
                           {"pbrt", add_export_pbrt}};
  const auto* entry = std::ranges::find_if(table, [&](const Command& c) { return words.back() == c.name; });
  CLI::App* parent = &program;
  if (words.size() == 2) parent = program.add_subcommand(words.front());
  CLI::App& command = *parent->add_subcommand(words.back());
  entry->add(command);
}

/// What a scene says in its place, but for where the output goes.
Words without_scene(const Words& typed) {
  CLI::App program("", "meniscus");
  const Command table[] = {{"render", add_render}, {"export", add_export}};
  for (const Command& command : table) command.add(*program.add_subcommand(command.name));
  Words words = with_scene(program, typed).words;
  if (words != typed)
    std::erase_if(words,
                  [](const std::string& word) { return word.starts_with("--output=") || word == "--trust-scene"; });
  return words;
}

void check_by_own_options(BundledCommand& result) {
  CLI::App program("", "meniscus");
  program.set_help_flag();
  let_the_last_count(program);
  // Thrown when all options are understood, before the command itself is called.
  program.parse_complete_callback([] { throw CLI::Success(); });
  add_command(program, result.words);
  Words all = result.words;
  all.insert(all.end(), result.arguments.begin(), result.arguments.end());
  all.insert(all.end(), result.device.begin(), result.device.end());
  all.insert(all.end(), {"-o", "out.png"});
  std::reverse(all.begin(), all.end());
  try {
    program.parse(all);
  } catch (const CLI::Success&) {
  } catch (const CLI::ParseError& error) {
    throw UsageError(fmt::format("behind --: {}", error.what()));
  }
}

void find_files(BundledCommand& result) {
  result.files.push_back({0, "", result.arguments.front()});
  for (const CommandOption& option : read_command_options({result.arguments.begin() + 1, result.arguments.end()}))
    if (option.reads_file)
      result.files.push_back({option.place + 1, option.joined ? option.name + "=" : "", option.value.value()});
}

void parse_shared_options(BundledCommand& result) {
  CLI::App command("", "meniscus");
  command.set_help_flag();
  let_the_last_count(command);
  command.allow_extras();
  add_molecule_options(command, result.molecule);
  FigureRequest figure;  // of render; the bundle needs to know what it reads, which is the same
  if (result.words.front() == "render") add_figure_options(command, result.molecule, figure);
  add_frame_options(command, result.frames);
  add_picture_options(command, result.picture);
  add_run_camera_options(command, result.camera_motion);
  Words all = result.arguments;
  std::reverse(all.begin(), all.end());
  command.parse(all);
}

}  // namespace

void parse_bundled_command(const Words& typed, BundledCommand& result) {
  const Words words = without_scene(typed);
  split(words, result);
  for (const std::string& word : result.arguments)
    if (kDecidedByBundle.contains(option_name(word)))
      throw UsageError(fmt::format("{} behind --: the bundle and its workers decide that; leave it out", word));
  take_out_device(result);
  check_by_own_options(result);
  find_files(result);
  parse_shared_options(result);
}

}  // namespace meniscus::farm
