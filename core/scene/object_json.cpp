// SPDX-License-Identifier: BSD-3-Clause
// Reads each key by the same parsers that options have.
#include "core/scene/object_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/text_file.h"
#include "core/base/text.h"
#include "core/color/color_maps.h"
#include "core/color/named_colors.h"
#include "core/properties/properties.h"

namespace meniscus {
namespace {

using Json = nlohmann::ordered_json;
using Kind = RepresentationRequest::Kind;

constexpr std::array<std::pair<std::string_view, Kind>, 4> kShapeWords{{{"sticks", Kind::sticks},
                                                                        {"balls", Kind::balls_and_sticks},
                                                                        {"spheres", Kind::spheres},
                                                                        {"tube", Kind::backbone}}};

constexpr auto kObjectKeys = std::to_array<ObjectKey>({
    {"representation", "surface, sticks, balls, spheres or tube", SceneForm::text},
    {"selection", "its atoms", SceneForm::text},
    {"color", "as --color, of this object [that of the molecule]", SceneForm::list},
    {"opacity", "as --opacity, of this object", SceneForm::list},
    {"map", "as --map, of a color by number", SceneForm::text},
    {"color_range", "as --color-range, likewise", SceneForm::text},
    {"missing_color", "as --missing-color, likewise", SceneForm::text},
    {"ambient", "of its material, 0 to 1 [as --ambient]", SceneForm::text},
    {"roughness", "likewise, 0 to 1", SceneForm::text},
    {"specular", "likewise, 0 to 1", SceneForm::text},
    {"shininess", "likewise, 1 to 1000", SceneForm::text},
    {"radius", "of sticks and tubes, Å", SceneForm::text},
    {"kind", "of a surface: ses, sas, vdw", SceneForm::text},
    {"probe", "of a surface: radius of the probe, Å [1.4]", SceneForm::text},
    {"show", "of a surface: as --show", SceneForm::text},
    {"clip", "of a surface: as --clip", SceneForm::list},
    {"cap_color", "as --cap-color", SceneForm::text},
    {"cap_hatching", "as --cap-hatching", SceneForm::text},
    {"film_opacity", "as --film-opacity", SceneForm::flag},
});

class ObjectReader {
  template <typename Parse>
  auto naming(const char* key, const Parse& parse) const {
    try {
      return parse();
    } catch (const SelectionError& error) {
      throw SelectionError(fmt::format("object: \"{}\": {}", key, error.sentence()), error.picture());
    } catch (const RequestError& error) {
      throw RequestError(fmt::format("object: \"{}\": {}", key, error.what()));
    }
  }

 public:
  explicit ObjectReader(const Json& json) : json_(json) {}

  FigureObjectRequest read() {
    const std::string representation = text("representation", "surface");
    const std::string selection = text("selection", "");
    if (selection.empty()) throw RequestError("object: \"selection\" is missing: which atoms is it made of?");
    FigureObjectRequest object{.atoms = naming("selection", [&] { return parse_selection(selection); })};
    const auto* const shape =
        std::ranges::find(kShapeWords, std::string_view(representation), &std::pair<std::string_view, Kind>::first);
    if (shape != kShapeWords.end())
      object.shapes = shape->second;
    else if (representation != "surface")
      refuse("representation", "is none of surface, sticks, balls, spheres, tube");
    read_colors(object);
    read_material(object.material);
    if (object.shapes)
      object.radius = number("radius", "shapes.stick_radius");
    else
      read_surface(object);
    for (const auto& [key, value] : json_.items())
      if (!known_.contains(key))
        throw RequestError(fmt::format("object: {} is no key of {}; there are {}", in_quotes(key), representation,
                                       fmt::join(known_, ", ")));
    return object;
  }

 private:
  [[noreturn]] void refuse(const std::string& key, std::string_view what) const {
    throw RequestError(fmt::format("object: \"{}\": {} {}", key, escaped(json_.at(key).dump()), what));
  }

  bool has(const std::string& key) {
    known_.insert(key);
    return json_.contains(key);
  }

  std::string text(const std::string& key, const char* otherwise) {
    if (!has(key)) return otherwise;
    if (!json_.at(key).is_string()) refuse(key, "is no text");
    return json_.at(key).get<std::string>();
  }

  /// Within the range of a property.
  std::optional<double> number(const std::string& key, std::string_view property_key) {
    if (!has(key)) return {};
    const Property& property = property_of(property_key);
    const Json& value = json_.at(key);
    if (!value.is_number() || !property.is_within(value.get<double>()))
      refuse(key, fmt::format("is not a number from {} to {}", property.lowest, property.highest));
    return value.get<double>();
  }

  bool flag(const std::string& key) {
    if (!has(key)) return false;
    if (!json_.at(key).is_boolean()) refuse(key, "is neither true nor false");
    return json_.at(key).get<bool>();
  }

  /// A text or a number, or a list of them.
  std::vector<std::string> words(const std::string& key) {
    std::vector<std::string> words;
    if (!has(key)) return words;
    const Json& value = json_.at(key);
    const auto add = [&](const Json& one) {
      if (!one.is_string() && !one.is_number()) refuse(key, "is neither a text nor a number nor a list of them");
      words.push_back(one.is_string() ? one.get<std::string>() : one.dump());
    };
    if (!value.is_array()) add(value);
    if (value.is_array())
      for (const Json& one : value) add(one);
    return words;
  }

  void read_colors(FigureObjectRequest& object) {
    ColorScheme color;
    bool own = false;
    for (const std::string& word : words("color")) {
      own = true;
      if (word.find('=') != std::string::npos) {
        color.rules.push_back(naming("color", [&] { return parse_color_rule(word); }));
        continue;
      }
      const std::optional<ColorScheme> scheme = parse_color_scheme(word);
      if (!scheme) refuse("color", "is none of " + color_scheme_words());
      color.by = scheme->by;
      color.fixed = scheme->fixed;
    }
    for (const std::string& word : words("opacity")) {
      object.opacities.push_back(naming("opacity", [&] { return parse_opacity_rule(word); }));
    }
    if (has("map")) {
      color.map = parse_color_map(text("map", ""));
      if (!color.map) refuse("map", "is the name of no map; meniscus colors lists them");
    }
    if (has("color_range")) {
      color.range = parse_color_range(text("color_range", ""));
      if (!color.range) refuse("color_range", "is not lo:hi with lo < hi, such as 10:60");
    }
    if (has("missing_color")) {
      color.missing = parse_color(text("missing_color", ""));
      if (!color.missing) refuse("missing_color", "is neither a colour's name such as red nor #rrggbb");
    }
    if ((color.map || color.range || color.missing) && !color.uses_scale())
      throw RequestError("object: \"map\", \"color_range\" and \"missing_color\" are for a \"color\" by a number");
    color.share_scale();
    if (own) object.color = std::move(color);
  }

  void read_material(MaterialRequest& material) {
    const auto take = [&](const std::string& key, std::optional<float>& value) {
      if (const std::optional<double> given = number(key, "look." + key)) value = static_cast<float>(*given);
    };
    take("ambient", material.ambient);
    take("roughness", material.roughness);
    take("specular", material.specular);
    take("shininess", material.shininess);
  }

  void read_surface(FigureObjectRequest& object) {
    const std::string kind = text("kind", "ses");
    if (kind == kind_word(SurfaceKind::sas))
      object.kind = SurfaceKind::sas;
    else if (kind == kind_word(SurfaceKind::vdw))
      object.kind = SurfaceKind::vdw;
    else if (kind != kind_word(SurfaceKind::ses))
      refuse("kind", "is none of ses, sas, vdw");
    if (const std::optional<double> radius = number("probe", "surface.probe")) {
      if (object.kind == SurfaceKind::vdw)
        throw RequestError("object: \"probe\": a van der Waals surface has none; leave it away");
      if (const std::string fault = probe_fault(*radius); !fault.empty()) refuse("probe", fault);
      object.probe_radius = *radius;
    }
    if (has("show")) object.show = naming("show", [&] { return parse_selection(text("show", "")); });
    for (const std::string& word : words("clip"))
      object.cuts.push_back(naming("clip", [&] { return parse_cut(word); }));
    const std::string cap = text("cap_color", "atom");
    if (cap != "atom") object.cap.color = parse_color(cap);
    if (cap != "atom" && !object.cap.color) refuse("cap_color", "is neither atom nor a colour");
    object.cap.hatching = number("cap_hatching", "surface.cap_hatching").value_or(0.0);
    object.thickens = flag("film_opacity");
  }

  const Json& json_;
  std::set<std::string> known_;
};

/// The shortest number that is the same float.
double shortest_number(float value) { return std::stod(fmt::format("{}", value)); }

/// One alone without a list around it.
void put_words(const char* key, const std::vector<std::string>& words, Json& json) {
  if (words.size() == 1) json[key] = words.front();
  if (words.size() > 1) json[key] = words;
}

void put_colors(const FigureObjectRequest& object, Json& json) {
  if (object.color) {
    std::vector<std::string> words{scheme_word(*object.color)};
    for (const ColorRule& rule : object.color->rules)
      words.push_back(rule.atoms.text() + "=" + scheme_word(rule.paint));
    put_words("color", words, json);
    if (object.color->map) json["map"] = map_name(*object.color->map);
    if (const auto& range = object.color->range) json["color_range"] = fmt::format("{}:{}", (*range)[0], (*range)[1]);
    if (object.color->missing) json["missing_color"] = hex_color(*object.color->missing);
  }
  std::vector<std::string> opacities;
  for (const OpacityRule& rule : object.opacities)
    opacities.push_back((rule.atoms ? rule.atoms->text() + "=" : "") + fmt::format("{}", rule.opacity));
  put_words("opacity", opacities, json);
}

void put_surface(const FigureObjectRequest& object, Json& json) {
  if (object.kind != SurfaceKind::ses) json["kind"] = kind_word(object.kind);
  if (object.kind != SurfaceKind::vdw && object.probe_radius != SurfaceRequest{}.probe_radius)
    json["probe"] = object.probe_radius;
  if (object.show) json["show"] = object.show->text();
  std::vector<std::string> cuts;
  for (const Cut& cut : object.cuts) cuts.push_back(cut_text(cut));
  put_words("clip", cuts, json);
  if (object.cap.color) json["cap_color"] = hex_color(*object.cap.color);
  if (object.cap.hatching > 0.0) json["cap_hatching"] = object.cap.hatching;
  if (object.thickens) json["film_opacity"] = true;
}

}  // namespace

std::span<const ObjectKey> object_keys() { return kObjectKeys; }

FigureObjectRequest parse_figure_object(std::string_view json) {
  if (is_nested_too_deep(json)) throw RequestError("object: JSON nested too deep");
  const Json object = Json::parse(json, nullptr, false);
  if (!object.is_object())
    throw RequestError(
        fmt::format(R"(object: {} is no JSON such as {{"representation": "sticks", "selection": "ligand"}})",
                    in_quotes(shortened(std::string(json), 60))));
  return ObjectReader(object).read();
}

Json figure_object_json(const FigureObjectRequest& object) {
  const auto* const shape =
      object.shapes ? std::ranges::find(kShapeWords, *object.shapes, &std::pair<std::string_view, Kind>::second)
                    : kShapeWords.end();
  Json json{{"representation", std::string(shape == kShapeWords.end() ? "surface" : shape->first)},
            {"selection", object.atoms.text()}};
  put_colors(object, json);
  const MaterialRequest& material = object.material;
  const auto put_number = [&](const char* key, const std::optional<float>& value) {
    if (value) json[key] = shortest_number(*value);
  };
  put_number("ambient", material.ambient);
  put_number("roughness", material.roughness);
  put_number("specular", material.specular);
  put_number("shininess", material.shininess);
  if (object.radius) json["radius"] = *object.radius;
  if (!object.shapes) put_surface(object, json);
  return json;
}

}  // namespace meniscus
