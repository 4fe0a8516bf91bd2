// SPDX-License-Identifier: BSD-3-Clause
// Sets and returns the values of scenes by the names and keys of properties.
#include "exporters/bindings/c/c_scene.h"

namespace meniscus::c_api {
namespace {

/// Returns the spelling of an option in messages of the library, such as "keep_water" and "frames=all".
std::string spelled(std::string_view option) {
  const std::size_t end = std::min(option.find(' '), option.size());
  const std::string name = "--" + std::string(option.substr(0, end));
  for (const Property* property : properties())
    if (is_scene_value(*property) && property->long_option() == name)
      return value_name(*property) + (end < option.size() ? "=" + std::string(option.substr(end + 1)) : "");
  return "the program's --" + std::string(option);
}

[[maybe_unused]] const bool kSpelled = (spell_options(spelled), true);

/// Returns the property of a name or key. Refuses an unknown name.
const Property& property_named(const char* name) {
  require(name, "name");
  try {
    return scene_property(name);
  } catch (const RequestError& error) {
    refuse(MENISCUS_USAGE, "{} {}", in_quotes(name), error.what());
  }
}

/// Returns true if the value of a flag by this name is the opposite of the option: a key means the value of scene
/// files, which for some flags is "true" by default.
bool is_negated_key(const Property& property, const char* name) {
  return property.has(negated) && property.key == name;
}

/// Returns a value as the text that set_value() takes; nothing if the text means the default.
std::optional<std::string> value_text(const Property& property, const char* name, const char* text) {
  if (!text) return {};
  const bool is_true = std::string_view(text) == "true", is_false = std::string_view(text) == "false";
  if (property.type == ValueType::flag) {
    if (!is_true && !is_false) refuse(MENISCUS_USAGE, "{}: {} is neither true nor false", name, in_quotes(text));
    if (is_false != is_negated_key(property, name)) return {};
    return "true";
  }
  if (property.has(value_optional) && is_false) return {};
  return property.has(value_optional) && is_true ? std::string() : std::string(text);
}

/// Returns a copy of a scene, in which one property has its default.
Scene without(const Scene& scene, const Property& left_out) {
  Scene rest;
  for (const Property* property : properties()) {
    if (property == &left_out || !is_scene_value(*property)) continue;
    if (const std::vector<std::string> texts = value_texts(scene, *property); !texts.empty())
      set_value(rest, *property, texts);
  }
  return rest;
}

/// The texts of a meniscus_property.
struct PropertyTexts {
  std::string name, key, value, help, words, initial;
};

/// Returns the rows of meniscus_scene_properties(), which are never freed.
const std::vector<meniscus_property>& property_rows() {
  static const std::vector<meniscus_property> rows = [] {
    static std::deque<PropertyTexts> texts;  // a deque does not move its elements
    std::vector<meniscus_property> result;
    for (const Property* property : properties()) {
      if (!is_scene_value(*property)) continue;
      const PropertyTexts& text = texts.emplace_back(
          PropertyTexts{value_name(*property), std::string(property->key), std::string(property->value),
                        with_options(property->help), std::string(property->words), with_options(property->initial)});
      result.push_back({text.name.c_str(), text.key.c_str(), text.value.c_str(), text.help.c_str(), text.words.c_str(),
                        text.initial.c_str(), property->lowest, property->highest,
                        static_cast<meniscus_value_type>(property->type), property->has(repeatable) ? 1 : 0,
                        is_of_surface(*property) ? 1 : 0, 0});
    }
    return result;
  }();
  return rows;
}

static_assert(static_cast<int>(ValueType::flag) == MENISCUS_VALUE_FLAG &&
              static_cast<int>(ValueType::number) == MENISCUS_VALUE_NUMBER &&
              static_cast<int>(ValueType::count) == MENISCUS_VALUE_COUNT &&
              static_cast<int>(ValueType::word) == MENISCUS_VALUE_WORD &&
              static_cast<int>(ValueType::text) == MENISCUS_VALUE_TEXT &&
              static_cast<int>(ValueType::file) == MENISCUS_VALUE_FILE &&
              static_cast<int>(ValueType::new_file) == MENISCUS_VALUE_NEW_FILE &&
              static_cast<int>(ValueType::camera) == MENISCUS_VALUE_CAMERA);

}  // namespace

void set_at(Scene& scene, const Property& property, const std::vector<std::string>& texts, meniscus_status status,
            const std::string& place) {
  try {
    set_value(scene, property, texts);
  } catch (const SelectionError& error) {
    refuse(status, "{}: {}\n{}", place, error.sentence(), error.picture());
  } catch (const RequestError& error) {
    refuse(status, "{}: {}", place, error.what());
  }
}

bool is_of_surface(const Property& property) {
  return property.section() == "look" || property.section() == "image" || property.key == "camera.projection" ||
         property.key == "surface.color";
}

Scene completed(const meniscus_scene& scene) {
  Scene copy = scene.copy();
  try {
    complete(copy);
  } catch (const ValueError& error) {
    refuse(MENISCUS_USAGE, "{}: {}", value_name(property_of(error.key())), error.what());
  }
  return copy;
}

}  // namespace meniscus::c_api

meniscus_status meniscus_scene_new(meniscus_scene** scene) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(scene, "scene");
    *scene = new meniscus_scene();
  });
}

meniscus_scene* meniscus_scene_retain(meniscus_scene* scene) { return meniscus::c_api::retain(scene); }
void meniscus_scene_release(meniscus_scene* scene) { meniscus::c_api::release(scene); }

meniscus_status meniscus_scene_set(meniscus_scene* scene, const char* name, const char* value) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(scene, "scene");
    const meniscus::Property& property = property_named(name);
    const std::optional<std::string> text = value_text(property, name, value);
    scene->change([&](meniscus::Scene& changed) {
      if (text)
        set_at(changed, property, {*text}, MENISCUS_USAGE, name);
      else
        changed = without(changed, property);
    });
  });
}

meniscus_status meniscus_scene_get(const meniscus_scene* scene, const char* name, std::size_t n, const char** value) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(scene, "scene");
    require(value, "value");
    const meniscus::Property& property = property_named(name);
    std::vector<std::string> texts = value_texts(scene->copy(), property);
    if (is_negated_key(property, name))
      for (std::string& text : texts) text = "false";
    *value = n < texts.size() ? scene->keep(texts[n]) : nullptr;
  });
}

meniscus_status meniscus_scene_size(const meniscus_scene* scene, std::int32_t* width, std::int32_t* height) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(scene, "scene");
    require(width, "width");
    require(height, "height");
    const glm::ivec2 size = completed(*scene).picture.size();
    *width = size.x;
    *height = size.y;
  });
}

meniscus_status meniscus_scene_properties(meniscus_array* array) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(array, "array");
    *array = table_of(property_rows());
  });
}
