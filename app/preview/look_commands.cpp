// SPDX-License-Identifier: BSD-3-Clause
// The commands that colour: schemes, rules, opacity, the look and the legend.
#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/preview/commands.h"
#include "app/preview/look_json.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/color_schemes.h"
#include "core/color/named_colors.h"
#include "core/properties/properties.h"
#include "core/scene/scene_values.h"

namespace meniscus {
namespace {

constexpr std::size_t kMostRules = 100;

/// "rules": a list of texts, as --color reads them.
std::vector<ColorRule> rules_of(const CommandReader& command) {
  std::vector<ColorRule> rules;
  const nlohmann::json& texts = command.value("rules");
  if (!texts.is_array() || texts.size() > kMostRules)
    throw RequestError(
        fmt::format("color: \"rules\" is a list of at most {} texts such as \"ligand=red\"", kMostRules));
  for (const nlohmann::json& text : texts) {
    if (!text.is_string()) throw RequestError("color: each of \"rules\" is a text such as \"ligand=red\"");
    try {
      rules.push_back(named_color_rule(text.get<std::string>()));
    } catch (const RequestError& error) {
      throw RequestError(std::string("color: ") + error.what());
    }
  }
  return rules;
}

/// "#rrggbb" or a name.
glm::vec3 named_color(const CommandReader& command, const char* key) {
  const std::optional<glm::vec3> color = parse_color(command.text(key));
  if (!color)
    throw RequestError(fmt::format("{}: \"{}\" is {}; it must be a colour's name such as red, or #rrggbb",
                                   command.word(), key, in_quotes(command.text(key))));
  return *color;
}

/// The scale of a scheme: as the command says, else its own.
void read_scale(const CommandReader& command, ColorScheme& color) {
  for (const char* key : {"map", "range", "missing"})
    if (command.has(key) && !color.uses_scale())
      throw RequestError(
          fmt::format("color: \"{}\" is for colours by a number, not {}", key, in_quotes(command.text("scheme"))));
  if (command.has("map")) {
    color.map = parse_color_map(command.text("map"));
    color.own_map.reset();
    if (!color.map)
      throw RequestError("color: " + in_quotes(command.text("map")) + " is not a map; see meniscus colors");
  }
  if (command.has("range")) {
    const std::string text = command.text("range");
    color.range = parse_color_range(text);
    if (!color.range && text != "auto")
      throw RequestError("color: \"range\" is " + in_quotes(text) + "; it must be auto or lo:hi with lo < hi");
  }
  if (command.has("missing")) color.missing = named_color(command, "missing");
}

/// The numbers of a file that a preview was begun with; of fluctuations there are others in their place.
const NumberFile& numbers_at_first(const ColorScheme& first) {
  static const NumberFile kNone;
  return first.by == ColorScheme::By::rmsf ? kNone : first.file;
}

}  // namespace

ColorScheme previewed_scheme(ColorScheme color, const ColorScheme& before, const ColorScheme& first, bool keeps_scale) {
  if (color.uses_file() && numbers_at_first(first).empty())
    throw RequestError("color: \"file\" needs numbers; begin the preview with --color-by-file FILE");
  color.set_numbers(numbers_at_first(first));
  if (color.by == ColorScheme::By::rmsf && color.by == first.by) color.file = first.file;
  require_previewed(color);
  if (color.by == ColorScheme::By::kind && !color.rules.empty())
    throw RequestError("color: \"kind\" colours patches, rules colour atoms; send \"rules\": [] with it");
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

Outcome set_color(const CommandReader& command, PreviewState state, const Surroundings& around) {
  const std::string word = command.text("scheme");
  std::optional<ColorScheme> scheme = parse_color_scheme(word);
  if (!scheme) throw RequestError("color: " + in_quotes(word) + " is not one of " + color_scheme_words());
  scheme->rules = command.has("rules") ? rules_of(command) : state.color.rules;
  state.color = previewed_scheme(*std::move(scheme), state.color, around.first.color, false);
  read_scale(command, state.color);
  state.color.share_scale();
  return {std::move(state), Renewal::colors};
}

Outcome paint(const CommandReader& command, PreviewState state, const Surroundings& around) {
  ColorScheme& color = state.color;
  const Selection selection = command.selection();
  if (color.by == ColorScheme::By::kind)
    throw RequestError("paint: kinds of patch are coloured now, not atoms; choose another scheme first");
  if (color.rules.size() == kMostRules)
    throw RequestError(fmt::format("paint: at most {} selections have colours of their own; remove one", kMostRules));
  const std::string rule = selection.text() + "=" + command.text("color");
  color.rules.push_back(command.naming([&] { return named_color_rule(rule); }));
  require_previewed(color);
  if (color.uses_file()) {
    const NumberFile& numbers = numbers_at_first(around.first.color);
    if (numbers.empty())
      throw RequestError("paint: \"file\" needs numbers; begin the preview with --color-by-file FILE");
    color.set_numbers(numbers);
  }
  color.share_scale();
  const std::size_t index = color.rules.size() - 1;
  return {std::move(state), Renewal::colors, {{"index", index}}};
}

Outcome set_patch_kinds(const CommandReader& command, PreviewState state, const Surroundings&) {
  state.patch_kinds = command.flag("on");
  return {std::move(state), Renewal::colors};
}

Outcome set_opacity(const CommandReader& command, PreviewState state, const Surroundings&) {
  std::vector<OpacityRule>& rules = state.color.opacities;
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

Outcome set_look(const CommandReader& command, PreviewState state, const Surroundings&) {
  state.look = changed_look(state.look, command);
  state.background = changed_background(state.background, command);
  return {std::move(state), Renewal::legend};
}

Outcome set_preset(const CommandReader& command, PreviewState state, const Surroundings& around) {
  const auto preset = static_cast<LookPreset>(command.choice("preset", property_of("look.preset")));
  return with_preset(std::move(state), preset, around);
}

Outcome with_preset(PreviewState state, LookPreset preset, const Surroundings& around) {
  const Preset& before = preset_of(state.preset);
  state.preset = preset;
  state.look = {};
  state.look.preset = state.preset;
  if (before.settings.empty() && preset_of(state.preset).settings.empty()) return {std::move(state), Renewal::legend};
  // The figure of the beginning takes the place of what another look draws.
  const SessionContext& context = around.exporter.context;
  Scene scene = rendered_scene(context.scene.value_or(Scene{}), {around.first, state.size, 1, false, {}, {}, {}});
  scene.molecule.color_named = context.scene && context.scene->molecule.color_named;
  scene.picture.camera_file.clear();
  scene.look = state.look;
  take_preset(scene);
  state.kind = scene.molecule.surface.kind;
  state.color = scene.molecule.color;
  state.figure = scene.figure;
  state.look = scene.look;
  if (scene.picture.zoom_to && context.aim) {
    state.camera = context.aim(scene, state.color, context.read_shown(state.figure, state.frame));
    state.overview = false;
  }
  return {std::move(state), Renewal::shapes, {}, true};
}

void require_legend_entries(bool is_shown, const ColorScheme& color) {
  if (is_shown && color.by == ColorScheme::By::fixed && color.rules.empty())
    throw RequestError("legend: there is nothing to explain: everything has one colour; choose another scheme first");
}

Outcome set_legend(const CommandReader& command, PreviewState state, const Surroundings&) {
  constexpr std::size_t kLongestTitle = 200;
  const auto is_usual = [&](const char* key) { return command.value(key).is_null(); };
  LegendStyle& style = state.legend_style;
  state.legend = command.flag_or(state.legend, "on");
  if (command.has("title")) {
    style.title.reset();
    if (!is_usual("title")) style.title = shortened(command.text("title"), kLongestTitle);
  }
  if (command.has("letters")) {
    style.letters.reset();
    if (!is_usual("letters")) style.letters = command.integer("letters", property_of("legend.size"));
  }
  if (command.has("place"))
    style.place = static_cast<LegendStyle::Place>(command.choice("place", property_of("legend.place")));
  require_legend_entries(state.legend, state.shown_scheme());
  return {.state = std::move(state), .renewal = Renewal::legend, .frames_all = true};
}

}  // namespace meniscus
