// SPDX-License-Identifier: BSD-3-Clause
// Colours and switches of the look, to and from JSON.
#include "app/preview/look_json.h"

#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/molecule/color_schemes.h"

namespace meniscus {
namespace {

constexpr std::array<std::string_view, 1> kKeys{"background"};

glm::vec3 background_of(const std::string& text) {
  if (text == "white") return glm::vec3(1.0f);
  if (text == "black") return glm::vec3(0.0f);
  const std::optional<glm::vec3> color = parse_hex_color(text);
  if (!color) throw RequestError("look: \"background\" is " + in_quotes(text) + "; it must be white, black or #rrggbb");
  return *color;
}

}  // namespace

std::string hex_color(const glm::vec3& color) {
  std::string text = "#";
  for (int c = 0; c < 3; ++c) text += fmt::format("{:02x}", std::lround(255.0f * color[c]));
  return text;
}

std::span<const std::string_view> look_keys() { return kKeys; }

Look changed_look(Look look, const CommandReader& command) {
  if (command.has("background")) look.background = background_of(command.text("background"));
  return look;
}

nlohmann::json look_json(const Look& look) { return {{"background", hex_color(look.background)}}; }

Look without_effects(Look look) { return look; }

}  // namespace meniscus
