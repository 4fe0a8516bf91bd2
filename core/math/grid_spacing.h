// SPDX-License-Identifier: BSD-3-Clause
// How wide the cells of a grid over points are, on the host and for kernels.
#pragma once

#include <cmath>
#include <cstddef>

#include <glm/vec3.hpp>

namespace meniscus {

/// The wanted edge of a cell, or a larger one where the extent would need more cells than a few per point: some atoms
/// far apart must not cost memory. All in Å.
inline double grid_spacing(const glm::dvec3& extent, std::size_t point_count, double wanted) {
  const double limit = 4.0 * static_cast<double>(point_count) + 64.0;
  double spacing = wanted;
  const auto cells = [&] {
    return (std::floor(extent.x / spacing) + 1) * (std::floor(extent.y / spacing) + 1) *
           (std::floor(extent.z / spacing) + 1);
  };
  while (cells() > limit) spacing *= 1.25;
  return spacing;
}

}  // namespace meniscus
