// SPDX-License-Identifier: BSD-3-Clause
// Converts colours and switches of the look to and from JSON.
#include "app/preview/look_json.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/named_colors.h"
#include "core/properties/properties.h"
#include "core/render/look.h"

namespace meniscus {
namespace {

/// What the look's command changes besides background and light: all numbers of a look, and of its lines the width of
/// all that are black, and that of those around patches.
std::vector<const LookNumber*> live_numbers() {
  std::vector<const LookNumber*> live;
  for (const LookNumber& number : look_numbers())
    if (number.in || number.key == "look.silhouettes" || number.key == "look.patch_lines") live.push_back(&number);
  return live;
}

std::string json_key(const LookNumber& number) { return std::string(property_of(number.key).name()); }

/// The shortest number that is the same float.
double shortest(float value) { return std::stod(fmt::format("{}", value)); }

}  // namespace

nlohmann::json look_json(Look look) {
  const glm::vec3& light = look.light_direction;
  nlohmann::json json{{"background", hex_color(look.background)},
                      {"light_direction", {shortest(light.x), shortest(light.y), shortest(light.z)}}};
  for (const LookNumber* number : live_numbers())
    if (number->in) json[json_key(*number)] = shortest(number->in(look));
  json["silhouettes"] = shortest(look.widest_silhouette());
  json["patch_lines"] = shortest(look.patch_lines);
  json["patch_line_color"] = hex_color(look.patch_line_color);
  return json;
}

Look without_effects(Look look) {
  look.ambient_occlusion = look.shadows = look.silhouettes = look.patch_lines = 0.0f;
  look.outer_lines = look.inner_lines = look.part_lines = {};
  return look;
}

}  // namespace meniscus
