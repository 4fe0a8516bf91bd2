// SPDX-License-Identifier: BSD-3-Clause
// Asks a volume map for the colour of a point that a ray met.
#include "core/color/color_scale.h"
#include "core/image/color_space.h"
#include "core/render/cpu/lane_kernels.h"

namespace meniscus {

glm::vec3 painted(const PointPaint& paint, std::uint32_t atom, const glm::vec4& atom_color, const glm::vec3& x,
                  const glm::vec3& normal) {
  if (paint.keeps_color[atom]) return glm::vec3(atom_color);
  return linear_from_srgb(paint.map->color(paint.pivot + glm::dvec3(x), glm::dvec3(normal)));
}

}  // namespace meniscus
