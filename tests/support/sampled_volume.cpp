// SPDX-License-Identifier: BSD-3-Clause
// Samples by strata: the points of a cell share its place, so only cells at the border add to the error.
#include "tests/support/sampled_volume.h"

#include <cmath>
#include <limits>

#include <glm/common.hpp>

namespace meniscus::testing {

VolumeEstimate sampled_volume(std::span<const Ball> balls, double probe_radius, const SphereTracer& oracle, int cells,
                              std::mt19937& random) {
  constexpr double kFar = std::numeric_limits<double>::max();
  glm::dvec3 low(kFar), high(-kFar);
  for (const Ball& b : balls) {
    low = glm::min(low, b.center - b.radius);
    high = glm::max(high, b.center + b.radius);
  }
  std::uniform_real_distribution<double> unit(0, 1);
  const glm::dvec3 step = (high - low) / double(cells);
  const auto solid = [&](const glm::ivec3& cell) {
    glm::dvec3 within;
    for (int axis = 0; axis < 3; ++axis) within[axis] = unit(random);
    const glm::dvec3 x = low + step * (glm::dvec3(cell) + within);
    return probe_radius > 0 ? oracle.nearest(x).distance >= probe_radius : oracle.outside(x) <= 0;
  };
  double sum = 0, variance = 0;
  for (int z = 0; z < cells; ++z)
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x) {
        const bool a = solid({x, y, z}), b = solid({x, y, z});
        sum += 0.5 * (a + b);
        variance += a != b ? 0.25 : 0.0;
      }
  const double cell = step.x * step.y * step.z;
  return {sum * cell, std::sqrt(variance) * cell, cell};
}

}  // namespace meniscus::testing
