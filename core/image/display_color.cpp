// SPDX-License-Identifier: BSD-3-Clause
// Blends in linear light, then goes to sRGB.
#include "core/image/display_color.h"

#include <algorithm>

#include "core/image/color_space.h"

namespace meniscus {

glm::vec4 over(const glm::vec4& front, const std::optional<glm::vec3>& background) {
  if (!background) return front;
  return {glm::vec3(front) + (1.0f - front.w) * linear_from_srgb(*background), 1.0f};
}

glm::vec4 display_color(const glm::vec4& pixel, const std::optional<glm::vec3>& background) {
  const glm::vec4 c = over(pixel, background);
  return {srgb_from_linear(c.w > 0.0f ? glm::vec3(c) / c.w : glm::vec3(0.0f)), c.w};
}

std::uint8_t display_byte(float channel) {
  return static_cast<std::uint8_t>(std::clamp(channel * 255.0f, 0.0f, 255.0f) + 0.5f);
}

}  // namespace meniscus
