// SPDX-License-Identifier: BSD-3-Clause
// Carries out the commands "set" and "add", which change the values of properties, and lists the properties for pages.

#include "app/preview/commands.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/color/color_schemes.h"
#include "core/scene/annotations.h"
#include "core/scene/molecule.h"
#include "core/scene/scene_json.h"
#include "core/scene/scene_value.h"
#include "core/scene/scene_values.h"

namespace meniscus {
namespace {

using Ordered = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

constexpr std::string_view kObjects = "figure.object";  // each of its texts is an object of scene files

/// Returns what must be made again if a property gets another value.
Renewal renewal_of(const Property& property, const PreviewFigure& figure) {
  constexpr std::string_view kOfCuts[] = {"surface.shown",    "surface.film_opacity", "surface.clip",
                                          "surface.clip_all", "surface.cap_color",    "surface.cap_hatching"};
  const std::string_view section = property.section();
  if (section == "figure" || property.key == "shapes.bare") return Renewal::shapes;
  if (std::ranges::find(kOfCuts, property.key) != std::end(kOfCuts)) return Renewal::cuts;
  // Another surface has the same colours, but its patches have other areas.
  if (changes_surface(property.key)) return figure.molecule.patches ? Renewal::colors : Renewal::legend;
  if (section == "surface" || section == "shapes") return Renewal::colors;
  return section == "camera" ? Renewal::nothing : Renewal::legend;
}

/// Returns the property that a key names, which previews can change.
const Property& live_property(const std::string& key) {
  std::vector<std::string_view> keys;
  for (const Property* property : properties()) {
    if (!property->has(live)) continue;
    if (property->key == key) return *property;
    keys.push_back(property->key);
  }
  const std::string_view nearest = nearest_word(key, keys);
  throw RequestError("set: \"key\" is {}, which is not a property that the preview changes{}", in_quotes(key),
                     nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest));
}

/// Returns the value in the form of replace_value(). Throws RequestError.
Texts given_texts(const Property& property, Ordered value) {
  if (value.is_null()) return {};
  if (property.key == kObjects && value.is_object()) value = Ordered::array({value});
  if (property.key == kObjects && value.is_array())
    for (Ordered& object : value)
      if (object.is_object()) object = object.dump();
  try {
    return texts_of_json(property, value);
  } catch (const RequestError& error) {
    throw RequestError("{} {}", in_quotes(shortened(value.dump(), 60)), error.what());
  }
}

/// Returns the type of a property's control, such as "flag", "selection", "length" or "text".
std::string_view control_of(const Property& property) {
  constexpr std::string_view kTypes[] = {"flag", "number", "count", "word"};
  if (property.type <= ValueType::word) return kTypes[static_cast<std::size_t>(property.type)];
  if (property.key == "surface.probe") return "number";
  if (property.has_range()) return "length";
  if (property.key == "look.light") return "direction";
  return property.value == "COLOR" ? "color" : property.value == "EXPR" ? "selection" : "text";
}

/// An entry of a list property that a command changes, adds or removes.
struct ListEntry {
  std::size_t index;
  bool is_removed;
};

/// Puts the texts of one entry into the list of all texts of its property: at the end if `index` is nothing. Without
/// texts the entry is removed. A new opacity replaces an earlier one of the same atoms.
ListEntry put_entry(std::optional<int> index, Texts entry, const Property& property, Texts& list) {
  if (property.key == "surface.opacity" && !index)
    std::erase_if(list, [&](const std::string& text) {
      return text.substr(0, text.rfind('=') + 1) == entry.back().substr(0, entry.back().rfind('=') + 1);
    });
  const std::size_t place = index ? static_cast<std::size_t>(*index) : list.size();
  const auto at = list.begin() + static_cast<std::ptrdiff_t>(place);
  const bool is_removed = entry.empty();
  list.insert(index ? list.erase(at) : at, entry.begin(), entry.end());
  return {place, is_removed};
}

/// Returns true if both objects are made of the same atoms in the same way, so that only their looks differ.
bool has_same_shape(const FigureObjectRequest& a, const FigureObjectRequest& b) {
  return a.shapes == b.shapes && a.text() == b.text() && a.radius == b.radius && a.kind == b.kind &&
         a.probe_radius == b.probe_radius;
}

/// Throws RequestError if a list of the scene is longer than previews draw, or a text longer than they write.
void check_extent(const Property& property, const Scene& scene) {
  constexpr std::size_t kMostEntries = 100, kMostCuts = 16, kLongestText = 200;
  const std::vector<std::string> texts = value_texts(scene, property);
  const bool is_drawn = property.section() == "figure";
  const std::size_t most = property.key == "surface.clip" ? kMostCuts : is_drawn ? kMostShown : kMostEntries;
  const std::size_t count =
      is_drawn ? scene.figure.representations.requests.size() + scene.figure.objects.size() : texts.size();
  if (count > most) throw RequestError("at most {} entries are allowed, not {}", most, count);
  if (property.section() == "legend" && !texts.empty() && texts.back().size() > kLongestText)
    throw RequestError("at most {} letters are allowed", kLongestText);
}

/// Throws RequestError for a value that contradicts others.
void check_among_others(const Property& property, const Scene& scene, const ShownMolecule& molecule) {
  const ColorScheme& color = scene.molecule.color;
  if (property.key == "surface.probe" && scene.molecule.surface.kind == SurfaceKind::vdw)
    throw RequestError("the van der Waals surface has no probe; choose another kind of surface first");
  if (!color.uses_scale() && (property.key == "surface.map" || property.key == "surface.color_range" ||
                              property.key == "surface.missing_color"))
    throw RequestError("is for colours by a number, not {}", in_quotes(scheme_word(color)));
  if (property.key == "surface.patches") patch_atoms(*scene.molecule.patches, molecule.annotated_structure());
  if (property.key == "annotations.labels") annotations_of(scene.annotations, molecule.annotated_structure());
  if (property.key == kObjects)
    for (const FigureObjectRequest& object : scene.figure.objects)
      if (object.color) require_previewed(*object.color);
  if (property.key == "legend.shown" && scene.legend.within && color.by == ColorScheme::By::fixed &&
      color.rules.empty())
    throw RequestError("there is nothing to explain: everything has one colour; choose another scheme first");
  if (scene.picture.fits) throw RequestError("'auto' is not a size in pixels, such as 1920x1080");
}

/// Returns the numbers of the file that a preview began with; none for measured fluctuations.
const NumberFile& numbers_at_first(const ColorScheme& first) {
  static const NumberFile kNone;
  return first.by == ColorScheme::By::rmsf ? kNone : first.file;
}

/// Returns a scheme whose word and rules were chosen, with the numbers, the scale and the title that it has in this
/// preview. If `keeps_scale` is true, the scheme keeps its map, its range and its colour of missing numbers. Otherwise
/// it takes them from the scheme that the preview began with, if both schemes are the same. Throws RequestError for a
/// scheme that previews do not show, and for rules in addition to kinds of patch.
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

/// Returns the state with the look of a preset. The figure that the preview began with replaces what the presets draw.
Outcome with_preset(PreviewState state, LookPreset preset, const Surroundings& around) {
  const Preset& before = preset_of(state.preset);
  state.preset = preset;
  state.look = {};
  state.look.preset = state.preset;
  if (before.settings.empty() && preset_of(state.preset).settings.empty()) return {std::move(state), Renewal::legend};
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

/// Changes whatever depends on a property that was set in the state.
void follow(const Property& property, PreviewState& state, const Surroundings& around) {
  const PreviewState& before = around.state;
  const ColorScheme& first = around.first.molecule.color;
  ColorScheme& color = state.molecule.color;
  if (property.key == "surface.color") {
    color = previewed_scheme(color, before.molecule.color, first, color.by == before.molecule.color.by);
  }
  if (property.key == "surface.map") color.own_map = color.map ? nullptr : first.own_map;
  color.share_scale();
  if (property.key == "camera.projection") {
    state.camera = projected(state.camera, std::exchange(state.picture.projection, {}), balls_in_view(around.molecule));
    state.overview = false;
  }
  require_copies_apart(around.molecule.structure(), state, before.probe_reach());
}

/// Returns a value as scene files have it, lists always as lists; the default where the scene has none, and null where
/// the default depends on other values.
Ordered value_json(const Property& property, const Scene& scene) {
  const Texts texts = value_texts(scene, property);
  if (property.type == ValueType::flag) return texts.empty() == property.has(negated);
  if (property.has(repeatable)) {
    Ordered list = Ordered::array();
    for (const std::string& text : texts)
      list.push_back(property.key == kObjects ? Ordered::parse(text, nullptr, false)
                                              : json_of_texts(property, {text}, ""));
    return list;
  }
  if (!texts.empty()) return json_of_texts(property, texts, "");
  // An initial value with spaces is a phrase for people. The initial value of an optional value applies only after the
  // property was set without a value, as with a scale bar without a length.
  const bool has_one = property.initial.find_first_of(" @") == property.initial.npos && property.key != "surface.map" &&
                       !property.has(value_optional);
  return property.initial.empty() || !has_one ? Ordered()
                                              : json_of_texts(property, {std::string(property.initial)}, "");
}

std::string label_of(const Property& property) {
  if (!property.label.empty()) return std::string(property.label);
  std::string label(property.name());
  std::ranges::replace(label, '_', ' ');
  if (const std::size_t color = label.find("color"); color != label.npos) label.replace(color, 5, "colour");
  label.front() = static_cast<char>(label.front() - 'a' + 'A');
  return label;
}

/// Returns the help in the words of pages, which have no options: "@color-by-file NUMBERS@" becomes "color by file".
std::string help_in_words(std::string_view help) {
  std::string words;
  bool is_option = false;
  for (const char letter : help) {
    if (letter == '@')
      is_option = !is_option;
    else
      words += is_option && letter == '-' ? ' ' : letter;
  }
  return words;
}

}  // namespace

Outcome set_property(const CommandReader& command, PreviewState state, const Surroundings& around) {
  const std::string word = command.word(), key = command.text("key");
  const Property& property = live_property(key);
  Ordered value(command.value("value"));
  constexpr std::string_view kSlid[] = {"number", "count", "length", "color", "direction"};
  std::optional<ListEntry> entry;
  try {
    Texts texts = given_texts(property, std::move(value));
    if (word == "add" || command.has("index")) {
      if (!property.has(repeatable)) throw RequestError("is one value and no list; use set without an index");
      if (property.key == "surface.color") state.molecule.color_named = true;  // the scheme is the first entry
      Texts list = value_texts(state, property);
      std::optional<int> index;
      if (word != "add") index = command.integer("index", 0, static_cast<int>(list.size()) - 1);
      if (!index && texts.empty()) throw RequestError("null is not a value to add");
      if (texts.size() > 1) throw RequestError("is a list; give one entry");
      entry = put_entry(index, std::move(texts), property, list);
      texts = std::move(list);
    }
    scene_values::replace_value(state, property, texts);
    if (property.key == "look.preset") return with_preset(std::move(state), state.look.preset, around);
    if (property.section() == "image" || control_of(property) == "length") scene_values::complete_lengths(state);
    if (!texts.empty()) check_extent(property, state);
    if (!texts.empty()) check_among_others(property, state, around.molecule);
    if (texts.empty() && property.key == "image.samples") state.image.samples = PreviewFigure().image.samples;
    if (property.key == "image.size" || property.key == "image.width" || property.key == "image.height")
      state.has_size = !texts.empty() || scene_values::has_lengths_of_sides(state);
    follow(property, state, around);
  } catch (const SelectionError& error) {
    throw RequestError("{}: {}: {}", word, key, error.sentence());
  } catch (const RequestError& error) {
    throw RequestError("{}: {}: {}", word, key, error.what());
  }
  const bool is_changed = entry && word != "add" && !entry->is_removed;
  // Successive places of a slider are one step; any other value is a step by itself.
  const bool is_slid =
      is_changed || (!property.has(repeatable) && std::ranges::find(kSlid, control_of(property)) != std::end(kSlid));
  const bool frames_all = property.key == "surface.kind" || property.section() == "legend";
  Renewal renewal = renewal_of(property, state);
  if (property.key == kObjects && is_changed &&
      has_same_shape(state.figure.objects[entry->index], around.state.figure.objects[entry->index]))
    renewal = Renewal::colors;
  nlohmann::json reply = nlohmann::json::object();
  if (property.key == "surface.show") reply["atoms"] = around.molecule.count_shown(state);
  if (word == "add") reply["index"] = entry->index;
  if (property.key == "surface.clip" && entry && !entry->is_removed)
    if (const auto idle =
            around.molecule.ineffective_among(std::span(state.figure.cuts).subspan(entry->index, 1), state);
        !idle.empty())
      reply["note"] = idle.front();
  std::string step = fmt::format("set {}", property.key);
  if (entry) step += fmt::format(" {}", entry->index);
  return {.state = std::move(state),
          .renewal = renewal,
          .reply = std::move(reply),
          .frames_all = frames_all,
          .is_own_step = !is_slid,
          .step = std::move(step)};
}

nlohmann::json property_values(const PreviewState& state) {
  Scene scene = state;
  if (!state.has_size) scene_values::replace_value(scene, property_of("image.size"), {});
  scene.picture.projection = state.camera.projection;
  scene.molecule.color_named = true;
  scene.look = look_request(state.look, state.full_look(), state.molecule.patches.has_value());
  scene.look.preset = state.preset;
  nlohmann::json values = nlohmann::json::object();
  for (const Property* property : properties())
    if (property->has(live)) values[std::string(property->key)] = nlohmann::json(value_json(*property, scene));
  return values;
}

nlohmann::json property_choices() {
  nlohmann::json choices = nlohmann::json::array();
  for (const Property* property : properties()) {
    if (!property->has(live)) continue;
    nlohmann::json& choice =
        choices.emplace_back(nlohmann::json{{"key", property->key},
                                            {"label", label_of(*property)},
                                            {"type", control_of(*property)},
                                            {"is_list", property->has(repeatable)},
                                            {"unit", property->value.starts_with("Å")   ? property->value
                                                     : property->value == "DEGREES"     ? "°"
                                                     : property->key == "surface.probe" ? "Å"
                                                                                        : ""},
                                            {"help", help_in_words(property->help)}});
    if (!property->words.empty()) choice["words"] = words_of(*property);
    if (!property->has_range()) continue;
    choice["lowest"] = property->lowest;
    choice["highest"] = property->highest;
    choice["step"] = property->type == ValueType::count ? 1.0 : property->highest <= 10.0 ? 0.01 : 0.1;
    if (property->slider_end > 0.0) choice["slider_end"] = property->slider_end;
  }
  return choices;
}

}  // namespace meniscus
