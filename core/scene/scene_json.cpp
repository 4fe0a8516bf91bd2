// SPDX-License-Identifier: BSD-3-Clause
// Reads and writes scenes, objects and values as JSON by the table of properties.
#include "core/scene/scene_json.h"

#include <iterator>
#include <set>
#include <system_error>

#include <fmt/ranges.h>

#include "core/base/system_file.h"
#include "core/scene/scene_values.h"

namespace meniscus {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_number()) throw RequestError("is neither a text nor a number");
  return value.dump();
}

std::string path_of(const Json& value) {
  if (!value.is_string() || value.get<std::string>().empty()) throw RequestError("is not a path");
  return value.get<std::string>();
}

/// Returns a JSON number if the text is written as JSON writes numbers, else a JSON text.
Json number_or_text(const std::string& text) {
  const Json number = Json::parse(text, nullptr, false);
  return number.is_number() && number.dump() == text ? number : Json(text);
}

std::string seen_from(const std::string& folder, const std::string& path) {
  const fs::path given = path_of_text(path);
  if (folder.empty()) return text_of_path(given.filename());
  const fs::path whole = fs::absolute(given), base = fs::absolute(path_of_text(folder));
  std::error_code failed;
  // A link within the folder keeps its name, because a scene may read no file outside of its folder. By names alone
  // "link/.." would be the folder of the link, so that equivalent() compares the files themselves.
  if (const fs::path within = whole.lexically_normal().lexically_relative(base.lexically_normal());
      !within.empty() && *within.begin() != ".." && fs::equivalent(base / within, whole, failed))
    return text_of_path(within);
  const fs::path seen = fs::proximate(whole, base, failed);
  return text_of_path(failed ? fs::absolute(given) : seen);
}

}  // namespace

std::vector<std::string> texts_of_json(const Property& property, const Json& value) {
  const SceneForm form = scene_form(property);
  switch (form) {
    case SceneForm::text_or_flag:
      if (value == false) return {};
      return {value == true ? std::string() : text_of(value)};
    case SceneForm::flag:
    case SceneForm::negated:
      if (!value.is_boolean()) throw RequestError("is neither true nor false");
      return {value.get<bool>() != property.has(negated) ? "true" : "false"};
    case SceneForm::text:
      return {text_of(value)};
    case SceneForm::path:
      return {path_of(value)};
    case SceneForm::camera:
      return {value.is_object() ? value.dump() : path_of(value)};
    case SceneForm::list:
    case SceneForm::paths:
      break;
  }
  std::vector<std::string> texts;
  for (const Json& one : value.is_array() ? value.get<std::vector<Json>>() : std::vector<Json>{value})
    texts.push_back(form == SceneForm::list ? text_of(one) : path_of(one));
  return texts;
}

Json json_of_texts(const Property& property, const std::vector<std::string>& texts, const std::string& folder) {
  Json list = Json::array();
  switch (scene_form(property)) {
    case SceneForm::flag:
      return true;
    case SceneForm::negated:
      return false;
    case SceneForm::text_or_flag:
      return texts.back() == "auto" ? Json(true) : number_or_text(texts.back());
    case SceneForm::text:
      return number_or_text(texts.back());
    case SceneForm::list:
      for (const std::string& text : texts) list.push_back(number_or_text(text));
      return list.size() == 1 ? list.front() : list;
    case SceneForm::path:
      return seen_from(folder, texts.back());
    case SceneForm::paths:
      for (const std::string& text : texts) list.push_back(seen_from(folder, text));
      return list;
    case SceneForm::camera:
      return texts.back().starts_with('{') ? Json::parse(texts.back(), nullptr, false)
                                           : Json(seen_from(folder, texts.back()));
  }
  return {};
}

namespace {

using Kind = RepresentationRequest::Kind;

/// The radius of sticks, and of tubes.
constexpr std::string_view kRadius = "radius", kRadiusProperty = "shapes.stick_radius";

/// Calls `read()`, and adds this key to the message of its exceptions.
template <typename Read>
auto naming(std::string_view key, const Read& read) {
  try {
    return read();
  } catch (const SelectionError& error) {
    throw SelectionError(fmt::format("object: \"{}\": {}", key, error.sentence()), error.picture());
  } catch (const RequestError& error) {
    throw RequestError("object: \"{}\": {}", key, error.what());
  }
}

/// Returns the text of a key that no property has.
std::string own_text(const Json& json, std::string_view key, const char* otherwise) {
  const auto found = json.find(key);
  if (found == json.end()) return otherwise;
  if (!found->is_string()) throw RequestError("object: \"{}\": {} is not a text", key, escaped(found->dump()));
  return found->get<std::string>();
}

std::optional<Kind> shapes_of(const std::string& representation) {
  if (representation == "surface") return {};
  const auto* const shape = std::ranges::find(kShapeWords, representation);
  if (shape == std::end(kShapeWords))
    throw RequestError("object: \"representation\": {} is not one of surface, {}", in_quotes(representation),
                       fmt::join(kShapeWords, ", "));
  return static_cast<Kind>(shape - kShapeWords);
}

const Property& property_of_key(const std::string& key, const std::string& representation) {
  std::vector<std::string_view> names{"representation", "selection"};
  for (const ObjectKey& known : object_keys()) {
    if (!(representation == "surface" ? known.of_surfaces : known.of_shapes)) continue;
    if (known.name == key) return *known.property;
    names.push_back(known.name);
  }
  throw RequestError("object: {} is not a key of {}; its keys are {}", in_quotes(key), representation,
                     fmt::join(names, ", "));
}

std::vector<std::string> texts_of(const Property& property, const std::string& key, const Json& value) {
  try {
    return texts_of_json(property, value);
  } catch (const RequestError& error) {
    throw RequestError("object: \"{}\": {} {}", key, escaped(value.dump()), error.what());
  }
}

/// Returns a scene with the object's own values.
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

/// Returns the object's own colours; nothing if it has the molecule's.
std::optional<ColorScheme> color_of(const Scene& own) {
  ColorScheme color = own.molecule.color;
  if ((color.map || color.range || color.missing) && !color.uses_scale())
    throw RequestError("object: \"map\", \"color_range\" and \"missing_color\" are for a \"color\" by a number");
  if (color.of_points() || color.by == ColorScheme::By::accessibility)
    throw RequestError("object: \"color\" cannot be {}, which needs all atoms", scheme_word(color));
  if (!own.molecule.color_named && color.rules.empty()) return {};
  color.opacities.clear();
  color.share_scale();
  return color;
}

/// Returns a scene with the object's values, for figure_object_json().
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
  const std::optional<Kind> shapes = shapes_of(representation);
  FigureObjectRequest object = naming("selection", [&] {
    if (shapes && draws_dashes(*shapes)) return parse_dashes(*shapes, selection);
    return FigureObjectRequest{.atoms = parse_selection(selection), .shapes = shapes};
  });
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
  Json json{{"representation", object.shapes ? shape_word(*object.shapes) : "surface"}, {"selection", object.text()}};
  const Scene own = values_of(object);
  for (const ObjectKey& key : object_keys()) {
    if (!(object.shapes ? key.of_shapes : key.of_surfaces)) continue;
    if (const std::vector<std::string> texts = value_texts(own, *key.property); !texts.empty())
      json[std::string(key.name)] = json_of_texts(*key.property, texts, "");
  }
  return json;
}

namespace {

constexpr const char* kVersionKey = "meniscus_scene";
constexpr const char* kSuperposedKey = "superposed";  // information for readers; it sets nothing
constexpr int kVersion = 1;

/// Parses the settings of one file.
class SceneParser {
 public:
  explicit SceneParser(const std::string& file) : file_(file) {}

  std::vector<SceneSetting> parse(std::string_view text) {
    const Json scene = json_of(text);
    for (const auto& [section, value] : scene.items()) {
      if (section == kVersionKey || section == kSuperposedKey || section == "objects") continue;
      check_section(section);
      if (!value.is_object()) fail(section, "is not a JSON object {...}");
      for (const auto& [key, own] : value.items())
        if (section != "molecule" || key != "select")
          add(property_of_key(section, key, fmt::format("{}.{}", section, key)), own,
              fmt::format("{}.{}", section, key));
    }
    read_objects(scene);
    std::vector<SceneSetting> ordered;
    for (const Property* property : properties())
      for (SceneSetting& setting : settings_)
        if (setting.property == property) ordered.push_back(std::move(setting));
    return ordered;
  }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& what) const {
    throw InputError(file_, 0, "scene: {} {}", place, what);
  }

  Json json_of(std::string_view text) const {
    if (is_nested_too_deep(text)) throw InputError(file_, 0, "scene: the JSON is nested too deep");
    Json scene;
    std::vector<std::set<std::string>> keys;  // keys of the objects that are open
    try {
      using Event = Json::parse_event_t;
      scene = Json::parse(text, [&](int, Event event, const Json& parsed) {
        if (event == Event::object_start) keys.emplace_back();
        if (event == Event::object_end) keys.pop_back();
        const std::string word = parsed.is_string() ? parsed.get<std::string>() : "";
        if (word.find('\0') != std::string::npos)
          fail(in_quotes(word), "contains a NUL character, which scenes do not allow");
        if (event == Event::key && !keys.back().insert(word).second)
          fail(in_quotes(word), "appears twice in one object; leave one of them out");
        return true;
      });
    } catch (const Json::parse_error& error) {
      const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
      throw InputError(file_, static_cast<std::size_t>(1 + std::count(text.begin(), end, '\n')),
                       "scene: this is not JSON");
    } catch (const Json::exception&) {
      throw InputError(file_, 0, "scene: a number is too large");
    }
    if (!scene.is_object() || !scene.contains(kVersionKey))
      throw InputError(file_, 0, "is not a scene: it has no \"{}\": {}", kVersionKey, kVersion);
    if (scene[kVersionKey] != kVersion)
      throw InputError(file_, 0, "scene: \"{}\" is {}; this program reads version {}", kVersionKey,
                       escaped(scene[kVersionKey].dump()), kVersion);
    return scene;
  }

  void check_section(const std::string& section) const {
    std::vector<std::string_view> sections{"objects"};
    for (const Property* property : properties())
      if (property->has(in_scene) && property->section() != "surface" &&
          std::ranges::find(sections, property->section()) == sections.end())
        sections.push_back(property->section());
    if (std::ranges::find(sections, section) == sections.end())
      fail(in_quotes(section), "is not part of a scene" + meant(section, sections));
  }

  static std::string meant(const std::string& word, const std::vector<std::string_view>& words) {
    const std::string_view nearest = nearest_word(word, words);
    return nearest.empty() ? fmt::format("; there are {}", fmt::join(words, ", "))
                           : fmt::format("; did you mean {}?", nearest);
  }

  const Property& property_of_key(std::string_view section, const std::string& key, const std::string& place) const {
    std::vector<std::string_view> keys;
    for (const Property* known : properties()) {
      if (!known->has(in_scene) || known->section() != section) continue;
      if (known->name() == key) return *known;
      keys.push_back(known->name());
    }
    fail(place, "is not a key" + meant(key, keys));
  }

  void set(const Property& property, std::vector<std::string> texts, const std::string& place) {
    settings_.push_back({&property, std::move(texts), place});
  }

  void add(const Property& property, const Json& value, const std::string& place) {
    try {
      if (std::vector<std::string> texts = texts_of_json(property, value); !texts.empty())
        set(property, std::move(texts), place);
    } catch (const RequestError& error) {
      fail(place, error.what());
    }
  }

  std::string text(const Json& value, const std::string& place) const {
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_number()) fail(place, "is neither a text nor a number");
    return value.dump();
  }

  void read_objects(const Json& scene) {
    std::string select, select_place = "molecule.select";
    if (scene.contains("molecule") && scene["molecule"].contains("select"))
      select = text(scene["molecule"]["select"], select_place);
    bool has_surface = !scene.contains("objects");
    if (!has_surface && !scene["objects"].is_array()) fail("objects", "is not a JSON list [...]");
    for (std::size_t n = 0; scene.contains("objects") && n < scene["objects"].size(); ++n) {
      const std::string place = fmt::format("objects[{}]", n);
      const Json& object = scene["objects"][n];
      if (!object.is_object()) fail(place, "is not a JSON object {...}");
      if (object.value("representation", Json("surface")) != "surface" || has_surface) {
        read_object(object, place);
        continue;
      }
      has_surface = true;
      for (const auto& [key, value] : object.items()) {
        const std::string own_place = place + "." + key;
        if (key == "selection") {
          const std::string own = text(value, own_place);
          select = select.empty() ? own : fmt::format("({}) and ({})", select, own);
          select_place = own_place;
        } else if (key != "representation") {
          add(property_of_key("surface", key, own_place), value, own_place);
        }
      }
    }
    if (!has_surface) set(meniscus::property_of("surface.shown"), {"true"}, "objects without a surface");
    if (!select.empty()) set(meniscus::property_of("molecule.select"), {select}, select_place);
  }

  void read_object(const Json& object, const std::string& place) {
    for (const std::string word : kShapeWords)
      if (object.size() == 2 && object.value("representation", Json()) == word && object.contains("selection"))
        return set(meniscus::property_of("figure." + word), {text(object["selection"], place + ".selection")}, place);
    set(meniscus::property_of("figure.object"), {object.dump()}, place);
  }

  const std::string& file_;
  std::vector<SceneSetting> settings_;
};

}  // namespace

std::vector<SceneSetting> parse_scene(std::string_view json, const std::string& file) {
  return SceneParser(file).parse(json);
}

std::string scene_text(const Scene& scene, const std::string& folder, std::span<const AddedFile> added) {
  Json sections;
  Json objects = Json::array({{{"representation", "surface"}}});
  for (const Property* property : properties()) {
    if (!property->has(in_scene) || (folder.empty() && property->section() == "output")) continue;
    const std::vector<std::string> texts = value_texts(scene, *property);
    if (texts.empty()) continue;
    const std::string section(property->section()), name(property->name());
    (section == "surface" ? objects.front() : sections[section])[name] = json_of_texts(*property, texts, folder);
  }
  for (const std::string word : kShapeWords)
    for (const std::string& selection : value_texts(scene, property_of("figure." + word)))
      objects.push_back({{"representation", word}, {"selection", selection}});
  for (const std::string& json : value_texts(scene, property_of("figure.object")))
    objects.push_back(Json::parse(json, nullptr, false));
  Json ordered{{kVersionKey, kVersion}};
  for (const char* section : {"molecule", "frames"})  // the content of a scene comes before its look
    if (sections.contains(section)) ordered[section] = sections[section];
  ordered["objects"] = std::move(objects);
  for (const auto& [section, keys] : sections.items())
    if (!ordered.contains(section)) ordered[section] = keys;
  for (const AddedFile& file : added)
    if (file.fit)
      ordered[kSuperposedKey].push_back({{"file", text_of_path(path_of_text(file.file).filename())},
                                         {"model", file.model},
                                         {"atoms", file.fit->atoms},
                                         {"rmsd", file.fit->rmsd}});
  return ordered.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace meniscus
