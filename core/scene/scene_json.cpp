// SPDX-License-Identifier: BSD-3-Clause
// Reads and writes the JSON of scenes by the table of properties.
#include "core/scene/scene_json.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/system_file.h"
#include "core/base/text_file.h"
#include "core/base/text.h"
#include "core/scene/scene_values.h"
#include "core/scene/value_json.h"

namespace meniscus {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kVersionKey = "meniscus_scene";
constexpr const char* kSuperposedKey = "superposed";  // for readers: it sets nothing
constexpr int kVersion = 1;

/// The settings of one file.
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
    throw InputError(file_, 0, fmt::format("scene: {} {}", place, what));
  }

  Json json_of(std::string_view text) const {
    if (is_nested_too_deep(text)) throw InputError(file_, 0, "scene: the JSON is nested too deep");
    Json scene;
    std::vector<std::set<std::string>> keys;  // of the objects that are open
    try {
      using Event = Json::parse_event_t;
      scene = Json::parse(text, [&](int, Event event, const Json& parsed) {
        if (event == Event::object_start) keys.emplace_back();
        if (event == Event::object_end) keys.pop_back();
        const std::string word = parsed.is_string() ? parsed.get<std::string>() : "";
        if (word.find('\0') != std::string::npos) fail(in_quotes(word), "holds a NUL, which no text of a scene has");
        if (event == Event::key && !keys.back().insert(word).second)
          fail(in_quotes(word), "is there twice in one object; leave one of them out");
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
      throw InputError(file_, 0, fmt::format("is not a scene: it has no \"{}\": {}", kVersionKey, kVersion));
    if (scene[kVersionKey] != kVersion)
      throw InputError(file_, 0,
                       fmt::format("scene: \"{}\" is {}; this program reads version {}", kVersionKey,
                                   escaped(scene[kVersionKey].dump()), kVersion));
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
  for (const char* section : {"molecule", "frames"})  // what is drawn, before how
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
