// SPDX-License-Identifier: BSD-3-Clause
// Reads and writes an object as a small scene: its keys and values are those of properties.
#include "core/scene/object_json.h"

#include <algorithm>
#include <iterator>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/scene/scene_values.h"
#include "core/scene/value_json.h"

namespace meniscus {
namespace {

using Json = nlohmann::ordered_json;
using Kind = RepresentationRequest::Kind;

/// Of sticks and of tubes.
constexpr std::string_view kRadius = "radius", kRadiusProperty = "shapes.stick_radius";

/// `read()`, with what it throws said of this key.
template <typename Read>
auto naming(std::string_view key, const Read& read) {
  try {
    return read();
  } catch (const SelectionError& error) {
    throw SelectionError(fmt::format("object: \"{}\": {}", key, error.sentence()), error.picture());
  } catch (const RequestError& error) {
    throw RequestError(fmt::format("object: \"{}\": {}", key, error.what()));
  }
}

/// The text of a key that no property has.
std::string own_text(const Json& json, std::string_view key, const char* otherwise) {
  const auto found = json.find(key);
  if (found == json.end()) return otherwise;
  if (!found->is_string())
    throw RequestError(fmt::format("object: \"{}\": {} is not a text", key, escaped(found->dump())));
  return found->get<std::string>();
}

std::optional<Kind> shapes_of(const std::string& representation) {
  if (representation == "surface") return {};
  const auto* const shape = std::ranges::find(kShapeWords, representation);
  if (shape == std::end(kShapeWords))
    throw RequestError(fmt::format(
        "object: \"representation\": {} is not one of surface, sticks, balls, spheres, tube, bases, glycans",
        in_quotes(representation)));
  return static_cast<Kind>(shape - kShapeWords);
}

const Property& property_of_key(const std::string& key, const std::string& representation) {
  std::vector<std::string_view> names{"representation", "selection"};
  for (const ObjectKey& known : object_keys()) {
    if (!(representation == "surface" ? known.of_surfaces : known.of_shapes)) continue;
    if (known.name == key) return *known.property;
    names.push_back(known.name);
  }
  throw RequestError(fmt::format("object: {} is not a key of {}; its keys are {}", in_quotes(key), representation,
                                 fmt::join(names, ", ")));
}

std::vector<std::string> texts_of(const Property& property, const std::string& key, const Json& value) {
  try {
    return texts_of_json(property, value);
  } catch (const RequestError& error) {
    throw RequestError(fmt::format("object: \"{}\": {} {}", key, escaped(value.dump()), error.what()));
  }
}

/// The object's own values.
Scene values_of(const Json& json, const std::string& representation) {
  Scene own;
  for (const auto& [key, value] : json.items()) {
    if (key == "representation" || key == "selection") continue;
    const Property& property = property_of_key(key, representation);
    const std::vector<std::string> texts = texts_of(property, key, value);
    if (!texts.empty()) naming(key, [&] { set_value(own, property, texts); });
  }
  return own;
}

/// Nothing: the molecule's.
std::optional<ColorScheme> color_of(const Scene& own) {
  ColorScheme color = own.molecule.color;
  if ((color.map || color.range || color.missing) && !color.uses_scale())
    throw RequestError("object: \"map\", \"color_range\" and \"missing_color\" are for a \"color\" by a number");
  if (color.of_points() || color.by == ColorScheme::By::accessibility)
    throw RequestError(fmt::format("object: \"color\" cannot be {}, which is of all atoms", scheme_word(color)));
  if (!own.molecule.color_named && color.rules.empty()) return {};
  color.opacities.clear();
  color.share_scale();
  return color;
}

/// What figure_object_json() writes as values.
Scene values_of(const FigureObjectRequest& object) {
  Scene own;
  if (object.color) {
    own.molecule.color = *object.color;
    own.molecule.color_named = true;
  }
  own.molecule.color.opacities = object.opacities;
  own.look.material = object.material;
  own.figure.representations.stick_radius = object.radius;
  own.molecule.surface.kind = object.kind;
  own.molecule.surface.probe_radius = object.probe_radius;
  own.molecule.show = object.show;
  own.figure.cuts = object.cuts;
  own.figure.cap = object.cap;
  own.figure.thickens = object.thickens;
  return own;
}

}  // namespace

const std::vector<ObjectKey>& object_keys() {
  static const std::vector<ObjectKey> keys = [] {
    std::vector<ObjectKey> all;
    for (const Property* property : properties())
      if (property->has(of_objects) || property->has(of_surfaces))
        all.push_back({property->name(), property, true, property->has(of_objects)});
    all.push_back({kRadius, &property_of(kRadiusProperty), false, true});
    return all;
  }();
  return keys;
}

FigureObjectRequest parse_figure_object(std::string_view text) {
  if (is_nested_too_deep(text)) throw RequestError("object: JSON nested too deep");
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object())
    throw RequestError(
        fmt::format(R"(object: {} is not JSON such as {{"representation": "sticks", "selection": "ligand"}})",
                    in_quotes(shortened(std::string(text), 60))));
  const std::string representation = own_text(json, "representation", "surface");
  const std::string selection = own_text(json, "selection", "");
  if (selection.empty()) throw RequestError("object: \"selection\" is missing; it names the object's atoms");
  FigureObjectRequest object{.atoms = naming("selection", [&] { return parse_selection(selection); })};
  object.shapes = shapes_of(representation);
  const Scene own = values_of(json, representation);
  const SurfaceRequest& surface = own.molecule.surface;
  if (surface.kind == SurfaceKind::vdw && surface.probe_named)
    throw RequestError("object: \"probe\": a van der Waals surface has none; leave it out");
  object.color = color_of(own);
  object.opacities = own.molecule.color.opacities;
  object.material = own.look.material;
  object.radius = own.figure.representations.stick_radius;
  object.kind = surface.kind;
  object.probe_radius = surface.probe_radius;
  object.show = own.molecule.show;
  object.cuts = own.figure.cuts;
  object.cap = own.figure.cap;
  object.thickens = own.figure.thickens;
  return object;
}

Json figure_object_json(const FigureObjectRequest& object) {
  Json json{{"representation", object.shapes ? shape_word(*object.shapes) : "surface"},
            {"selection", object.atoms.text()}};
  const Scene own = values_of(object);
  for (const ObjectKey& key : object_keys()) {
    if (!(object.shapes ? key.of_shapes : key.of_surfaces)) continue;
    if (const std::vector<std::string> texts = value_texts(own, *key.property); !texts.empty())
      json[std::string(key.name)] = json_of_texts(*key.property, texts, "");
  }
  return json;
}

}  // namespace meniscus
