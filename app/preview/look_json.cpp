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

glm::vec3 color_at(const CommandReader& command, const char* key) {
  const std::string text = command.text(key);
  const std::optional<glm::vec3> color = parse_color(text);
  if (!color)
    throw RequestError(
        fmt::format("look: \"{}\" is {}; it must be a colour's name such as grey, or #rrggbb", key, in_quotes(text)));
  return *color;
}

glm::vec3 direction_of(const nlohmann::json& value) {
  glm::vec3 direction{0.0f};
  bool numbers = value.is_array() && value.size() == 3;
  for (int c = 0; numbers && c < 3; ++c) {
    numbers = value[c].is_number();
    if (numbers) direction[c] = value[c].get<float>();
  }
  const float length = std::hypot(direction.x, direction.y, direction.z);
  if (!numbers || !std::isfinite(length) || length < 1e-6f)
    throw RequestError("look: \"light_direction\" must be three numbers that are not all 0, such as [-1, 1, 1]");
  return direction;
}

/// The shortest number that is the same float.
double shortest(float value) { return std::stod(fmt::format("{}", value)); }

}  // namespace

std::vector<std::string_view> look_keys() {
  std::vector<std::string_view> keys{"background", "light_direction", "patch_line_color"};
  for (const LookNumber* number : live_numbers()) keys.push_back(property_of(number->key).name());
  return keys;
}

LookRequest changed_look(LookRequest look, const CommandReader& command) {
  if (command.has("light_direction")) look.light_direction = direction_of(command.value("light_direction"));
  if (command.has("patch_line_color")) look.patch_line_color = color_at(command, "patch_line_color");
  if (command.has("silhouettes")) look.outer_lines = look.inner_lines = look.part_lines = {};
  for (const LookNumber* number : live_numbers()) {
    const Property& property = property_of(number->key);
    const std::string key = json_key(*number);
    if (command.has(key.c_str()))
      *number->requested(look) = static_cast<float>(command.number(key.c_str(), property.lowest, property.highest));
  }
  return look;
}

glm::vec3 changed_background(const glm::vec3& background, const CommandReader& command) {
  return command.has("background") ? color_at(command, "background") : background;
}

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

nlohmann::json look_sliders() {
  nlohmann::json sliders = nlohmann::json::array();
  for (const Property* property : properties())
    if (property->section() == "look" && property->slider_end > 0.0)
      sliders.push_back({{"key", property->name()},
                         {"label", property->label},
                         {"end", property->slider_end},
                         {"help", with_options(property->help)}});
  return sliders;
}

Look without_effects(Look look) {
  look.ambient_occlusion = look.shadows = look.silhouettes = look.patch_lines = 0.0f;
  look.outer_lines = look.inner_lines = look.part_lines = {};
  return look;
}

}  // namespace meniscus
