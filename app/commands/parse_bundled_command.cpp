// SPDX-License-Identifier: BSD-3-Clause
// Parses the options of a bundled command, without running it.
#include "app/commands/parse_bundled_command.h"

#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/commands/blender_meshes.h"
#include "app/commands/povray_figures.h"
#include "app/commands/traced_scene.h"
#include "app/farm/bundle.h"
#include "app/options/property_options.h"
#include "app/options/usage_faults.h"
#include "app/process/program_error.h"
#include "core/base/text.h"

namespace meniscus::farm {
namespace {

using Words = std::vector<std::string>;

const std::set<std::string, std::less<>> kDecidedByBundle{"-o",     "--output",   "--force",
                                                          "--only", "--progress", "--save-camera"};
constexpr const char* kDeviceOptions[] = {"--device", "--threads", "--require-gpu", "--jobs"};
constexpr const char* kProvenance[] = {"--provenance", "--no-provenance"};

/// The words after the command's name, and the renderer's options.
struct Parts {
  Words command, arguments, renderer;
};

Parts parts_of(const Words& words) {
  if (words.empty()) throw UsageError("there is no command after --; write one such as -- render FILE --frames all");
  const std::size_t count = words.front() == "export" ? 2 : 1;
  if (words.size() <= count) throw UsageError("there is no FILE after --");
  const auto behind = words.begin() + static_cast<std::ptrdiff_t>(count);
  const auto second = std::find(behind, words.end(), "--");
  Parts parts{{words.begin(), behind}, {behind, second}, {}};
  const std::vector<Step> steps = steps_of(parts.command);
  const bool has_scene = std::ranges::any_of(
      parts.arguments, [](const std::string& word) { return word == "--scene" || word.starts_with("--scene="); });
  if (behind->starts_with('-') && !has_scene)
    throw UsageError(fmt::format("name FILE directly after {}, then options; standard input cannot be bundled",
                                 fmt::join(parts.command, " ")));
  if (second != words.end()) parts.renderer.assign(second + 1, words.end());
  if (!parts.renderer.empty() && (words.front() == "render" || steps.size() == 1))
    throw UsageError(fmt::format("no renderer is started for {}; leave out what follows the second --",
                                 fmt::join(parts.command, " ")));
  return parts;
}

/// Refuses options that a bundle does not have: options that it decides by itself, and options that write files. A
/// legend is written when the bundle is made.
void refuse_options(const Words& arguments) {
  for (const std::string& word : arguments) {
    const std::string_view name = std::string_view(word).substr(0, word.find('='));
    if (kDecidedByBundle.contains(name))
      throw UsageError(fmt::format("{} after --: the bundle and its workers decide that; leave it out", word));
    const auto is_named = [&](const Property* property) { return property->long_option() == name; };
    const auto is_possible = [&](const Property* property) {
      return is_named(property) &&
             (property->has(in_bundle) || property->section() == "scene" || property->key == "legend.file" ||
              std::ranges::find(kDeviceOptions, name) != std::end(kDeviceOptions));
    };
    if (std::ranges::any_of(properties(), is_named) && std::ranges::none_of(properties(), is_possible))
      throw RequestError(fmt::format("{} is not supported in farm bundles", in_quotes(name)));
  }
}

TakenProperties properties_of(const Words& command) {
  const std::string& name = command.back();
  return name == "render"    ? render_properties()
         : name == "povray"  ? povray_properties()
         : name == "blender" ? blender_properties()
                             : traced_properties();
}

/// Returns the typed options with their values.
Words typed(const CLI::App& command, std::span<const char* const> options) {
  Words words;
  for (const char* const name : options) {
    const CLI::Option* const option = command.get_option_no_throw(name);
    if (!option || option->count() == 0) continue;
    words.emplace_back(name);
    if (option->get_expected_max() > 0) words.push_back(option->results().back());
  }
  return words;
}

}  // namespace

BundledCommand parse_bundled_command(const Words& words) {
  const Parts parts = parts_of(words);
  refuse_options(parts.arguments);
  CLI::App app("", parts.command.back());
  app.set_help_flag();
  let_the_last_count(app);
  DeclaredCommand<> declared(app, properties_of(parts.command));
  if (parts.command.back() == "render") {
    declared.options.describe_output("", OutputName::optional);
    PropertyOptions options(app);
    options.add_switch("picture.provenance", [] {});
    options.add_switch("picture.no_provenance", [] {});
  }
  Words arguments(parts.arguments.rbegin(), parts.arguments.rend());
  try {
    app.parse(arguments);
    declared.options.take();
  } catch (const CLI::ParseError& error) {
    throw UsageError(fmt::format("after --: {}", error.what()));
  }
  if (declared.state.scene.molecule.file == "-") throw UsageError("standard input cannot be bundled; name a FILE");
  return {parts.command, declared.state, typed(app, kProvenance), typed(app, kDeviceOptions), parts.renderer};
}

}  // namespace meniscus::farm
