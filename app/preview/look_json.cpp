// SPDX-License-Identifier: BSD-3-Clause
// Writes the numbers and colours of the look as JSON.
#include "app/preview/look_json.h"

#include <string>

#include <fmt/format.h>

#include "core/color/named_colors.h"
#include "core/properties/properties.h"
#include "core/render/look.h"

namespace meniscus {
namespace {

/// The shortest number that is the same float.
double shortest(float value) { return std::stod(fmt::format("{}", value)); }

}  // namespace

nlohmann::json look_json(Look look) {
  const glm::vec3& light = look.light_direction;
  nlohmann::json json{{"background", hex_color(look.background)},
                      {"light_direction", {shortest(light.x), shortest(light.y), shortest(light.z)}}};
  for (const LookNumber& number : look_numbers())
    if (number.in) json[std::string(property_of(number.key).name())] = shortest(number.in(look));
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
