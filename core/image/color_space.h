// SPDX-License-Identifier: BSD-3-Clause
// Between sRGB and linear light (IEC 61966-2-1).
#pragma once

#include <glm/vec3.hpp>

namespace meniscus {

/// One channel in [0, 1] each way.
float linear_from_srgb(float value);
float srgb_from_linear(float value);

inline glm::vec3 linear_from_srgb(const glm::vec3& c) {
  return {linear_from_srgb(c.x), linear_from_srgb(c.y), linear_from_srgb(c.z)};
}
inline glm::vec3 srgb_from_linear(const glm::vec3& c) {
  return {srgb_from_linear(c.x), srgb_from_linear(c.y), srgb_from_linear(c.z)};
}

}  // namespace meniscus
