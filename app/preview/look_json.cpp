// SPDX-License-Identifier: BSD-3-Clause
// Colours and switches of the look, to and from JSON.
#include "app/preview/look_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/css_colors.h"

namespace meniscus {
namespace {

constexpr std::array<std::string_view, 7> kKeys{"background",        "light_direction",          "light_strength",
                                                "ambient_occlusion", "ambient_occlusion_radius", "silhouettes",
                                                "depth_cue"};

/// A number of the look, as the options of `meniscus render` bound it.
struct Strength {
  const char* key;
  std::optional<float> LookRequest::*asked;
  float Look::*value;
  double lowest, highest;
};
using Asked = LookRequest;
constexpr Strength kStrengths[] = {
    {"light_strength", &Asked::light_strength, &Look::light_strength, 0.0, 10.0},
    {"ambient_occlusion", &Asked::ambient_occlusion, &Look::ambient_occlusion, 0.0, 1.0},
    {"ambient_occlusion_radius", &Asked::ambient_occlusion_radius, &Look::ambient_occlusion_radius, 0.1, 1000.0},
    {"silhouettes", &Asked::silhouettes, &Look::silhouettes, 0.0, kWidestSilhouette},
    {"depth_cue", &Asked::depth_cue, &Look::depth_cue, 0.0, 1.0}};

glm::vec3 background_of(const std::string& text) {
  if (text == "white") return glm::vec3(1.0f);
  if (text == "black") return glm::vec3(0.0f);
  const std::optional<glm::vec3> color = parse_hex_color(text);
  if (!color) throw RequestError("look: \"background\" is " + in_quotes(text) + "; it must be white, black or #rrggbb");
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

std::span<const std::string_view> look_keys() { return kKeys; }

LookRequest changed_look(LookRequest look, const CommandReader& command) {
  if (command.has("light_direction")) look.light_direction = direction_of(command.value("light_direction"));
  if (command.has("silhouettes")) look.outer_lines = look.inner_lines = look.part_lines = {};
  for (const Strength& strength : kStrengths)
    if (command.has(strength.key))
      look.*strength.asked = static_cast<float>(command.number(strength.key, strength.lowest, strength.highest));
  return look;
}

glm::vec3 changed_background(const glm::vec3& background, const CommandReader& command) {
  return command.has("background") ? background_of(command.text("background")) : background;
}

nlohmann::json look_json(const Look& look) {
  const glm::vec3& light = look.light_direction;
  nlohmann::json json{{"background", hex_color(look.background)},
                      {"light_direction", {shortest(light.x), shortest(light.y), shortest(light.z)}}};
  for (const Strength& strength : kStrengths) json[strength.key] = shortest(look.*strength.value);
  json["silhouettes"] = shortest(look.widest_line());
  return json;
}

Look without_effects(Look look) {
  look.ambient_occlusion = look.silhouettes = 0.0f;
  look.outer_lines = look.inner_lines = look.part_lines = {};
  return look;
}

}  // namespace meniscus
