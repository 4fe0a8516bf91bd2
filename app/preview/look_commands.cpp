// SPDX-License-Identifier: BSD-3-Clause
// The commands that colour, and what presets and schemes are in a preview.
#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/preview/commands.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/color_schemes.h"
#include "core/properties/properties.h"
#include "core/scene/scene_values.h"

namespace meniscus {
namespace {

constexpr std::size_t kMostRules = 100;

/// The numbers of a file that a preview was begun with; of fluctuations there are others in their place.
const NumberFile& numbers_at_first(const ColorScheme& first) {
  static const NumberFile kNone;
  return first.by == ColorScheme::By::rmsf ? kNone : first.file;
}

}  // namespace

ColorScheme previewed_scheme(ColorScheme color, const ColorScheme& before, const ColorScheme& first, bool keeps_scale) {
  if (color.uses_file() && numbers_at_first(first).empty())
    throw RequestError("'file' needs numbers; begin the preview with --color-by-file FILE");
  color.set_numbers(numbers_at_first(first));
  if (color.by == ColorScheme::By::rmsf && color.by == first.by) color.file = first.file;
  require_previewed(color);
  if (color.by == ColorScheme::By::kind && !color.rules.empty())
    throw RequestError("'kind' colours patches, and rules colour atoms; leave the rules out");
  color.opacities = before.opacities;
  color.title = before.title;
  color.unit = before.unit;
  const ColorScheme none, &beginning = color.by == first.by && color.has_scale() ? first : none;
  const ColorScheme& scale = keeps_scale ? before : beginning;
  color.map = scale.map;
  color.range = scale.range;
  color.missing = scale.missing;
  color.own_map = color.uses_scale() ? (keeps_scale ? before : first).own_map : nullptr;
  color.share_scale();
  return color;
}

Outcome paint(const CommandReader& command, PreviewState state, const Surroundings& around) {
  ColorScheme& color = state.molecule.color;
  const Selection selection = command.selection();
  if (color.by == ColorScheme::By::kind)
    throw RequestError("paint: kinds of patch are coloured now, not atoms; choose another scheme first");
  if (color.rules.size() == kMostRules)
    throw RequestError(fmt::format("paint: at most {} selections have colours of their own; remove one", kMostRules));
  const std::string rule = selection.text() + "=" + command.text("color");
  color.rules.push_back(command.naming([&] { return named_color_rule(rule); }));
  require_previewed(color);
  if (color.uses_file()) {
    const NumberFile& numbers = numbers_at_first(around.first.molecule.color);
    if (numbers.empty())
      throw RequestError("paint: \"file\" needs numbers; begin the preview with --color-by-file FILE");
    color.set_numbers(numbers);
  }
  color.share_scale();
  const std::size_t index = color.rules.size() - 1;
  return {std::move(state), Renewal::colors, {{"index", index}}};
}

Outcome set_opacity(const CommandReader& command, PreviewState state, const Surroundings&) {
  std::vector<OpacityRule>& rules = state.molecule.color.opacities;
  OpacityRule rule;
  rule.opacity = static_cast<float>(command.number("opacity", 0.0, 1.0));
  std::size_t index = rules.size();
  if (command.has("index")) {
    index = static_cast<std::size_t>(command.integer("index", 0, static_cast<int>(rules.size()) - 1));
    rules[index].opacity = rule.opacity;
  } else {
    if (command.has("selection")) rule.atoms = command.selection();
    const auto same = std::ranges::find_if(rules, [&](const OpacityRule& known) {
      return known.atoms.has_value() == rule.atoms.has_value() &&
             (!rule.atoms || known.atoms->text() == rule.atoms->text());
    });
    if (same == rules.end() && rules.size() == kMostRules)
      throw RequestError(fmt::format("opacity: at most {} selections have one of their own; remove one", kMostRules));
    if (same != rules.end()) rules.erase(same);  // the last counts
    rules.push_back(rule);
    index = rules.size() - 1;
  }
  return {std::move(state), Renewal::colors, {{"index", index}}};
}

Outcome with_preset(PreviewState state, LookPreset preset, const Surroundings& around) {
  const Preset& before = preset_of(state.preset);
  state.preset = preset;
  state.look = {};
  state.look.preset = state.preset;
  if (before.settings.empty() && preset_of(state.preset).settings.empty()) return {std::move(state), Renewal::legend};
  // The figure of the beginning takes the place of what another look draws.
  const SessionContext& context = around.exporter.context;
  Scene scene = around.first;
  scene.picture.width = state.size.x;
  scene.picture.height = state.size.y;
  scene.look = state.look;
  take_preset(scene);
  state.molecule.surface.kind = scene.molecule.surface.kind;
  state.molecule.color = scene.molecule.color;
  state.figure = scene.figure;
  state.look = scene.look;
  if (scene.picture.zoom_to && context.aim) {
    state.camera = context.aim(scene, context.read_shown(state.figure, state.frame));
    state.overview = false;
  }
  return {std::move(state), Renewal::shapes, {}, true};
}

}  // namespace meniscus
