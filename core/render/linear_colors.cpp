// SPDX-License-Identifier: BSD-3-Clause
// Converts colours from sRGB to linear light, and puts opacity into alpha.
#include "core/render/linear_colors.h"

#include <cstdint>

#include "core/color/coloring.h"
#include "core/image/color_space.h"

namespace meniscus {

std::vector<glm::vec4> linear_colors(const Coloring& coloring) {
  const auto atom_count = static_cast<std::uint32_t>(coloring.atom.size());
  std::vector<glm::vec4> colors;
  colors.reserve(atom_count + 3);
  for (std::uint32_t a = 0; a < atom_count; ++a)
    colors.emplace_back(linear_from_srgb(coloring.atom[a]), coloring.shows(a) ? coloring.opacity_of(a) : 0.0f);
  if (coloring.kind)
    for (const glm::vec3& color : *coloring.kind) colors.emplace_back(linear_from_srgb(color), 1.0f);
  return colors;
}

}  // namespace meniscus
