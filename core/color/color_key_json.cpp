// SPDX-License-Identifier: BSD-3-Clause
// Writes the scale and the classes of a colour key as JSON.
#include "core/color/color_key_json.h"

#include <nlohmann/json.hpp>

#include "core/base/text.h"

namespace meniscus {

nlohmann::ordered_json color_key_json(const ColorKey& key) {
  using Json = nlohmann::ordered_json;
  const auto triple = [](const glm::vec3& c) { return Json{c.x, c.y, c.z}; };
  Json json{{"title", key.title}};
  if (key.scale) {
    const ColorScale& scale = *key.scale;
    json = {{"title", scale.title}, {"unit", scale.unit},       {"map", scale.own_map ? "own" : map_name(scale.map)},
            {"range", scale.range}, {"missing", scale.missing}, {"missing_color", triple(scale.missing_color)}};
  }
  if (key.scale && !key.scale->ends[0].empty()) json["ends"] = key.scale->ends;
  if (!key.classes.empty()) json["classes"] = Json::array();
  for (const ColorClass& entry : key.classes)
    json["classes"].push_back({{"name", escaped(entry.name)}, {"color", triple(entry.color)}});
  for (const ColorKey& other : key.others) json["others"].push_back(color_key_json(other));
  return json;
}

}  // namespace meniscus
