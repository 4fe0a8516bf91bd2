// SPDX-License-Identifier: BSD-3-Clause
// What letters on a picture are coloured, so that they can be read.
#pragma once

#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "core/image/color_space.h"

namespace meniscus {

/// Whether letters on this sRGB background are dark; on none they are, as for paper. At the luminance (IEC 61966-2-1)
/// where it changes black and white letters have the same contrast ratio (WCAG 2.1).
inline bool is_ink_dark(const std::optional<glm::vec3>& background) {
  return !background || glm::dot(linear_from_srgb(*background), glm::vec3(0.2126f, 0.7152f, 0.0722f)) > 0.179f;
}

/// Of letters, sRGB; and of a rim around them that sets them off from what is behind.
inline glm::vec3 ink_on(const std::optional<glm::vec3>& background) {
  return glm::vec3(is_ink_dark(background) ? 0.07f : 0.95f);
}
inline glm::vec3 rim_on(const std::optional<glm::vec3>& background) {
  return glm::vec3(is_ink_dark(background) ? 1.0f : 0.0f);
}

}  // namespace meniscus
