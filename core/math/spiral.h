// SPDX-License-Identifier: BSD-3-Clause
// Directions that are evenly distributed over a sphere, along the Fibonacci spiral.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

#include <glm/vec3.hpp>

namespace meniscus {

/// Returns the n-th of `count` unit directions, each of which has the same share of the sphere (R. Swinbank and R. J.
/// Purser 2006). As measured for counts from 12 to 1,500, no direction is farther from the nearest of them than 0.77
/// times the square root of that share.
inline glm::dvec3 spiral_direction(std::size_t n, std::size_t count) {
  const auto k = static_cast<double>(n);
  const double z = (2 * k + 1.0) / static_cast<double>(count) - 1, turn = 2 * std::numbers::pi * std::numbers::phi * k,
               across = std::sqrt(1 - z * z);
  return {across * std::cos(turn), across * std::sin(turn), z};
}

}  // namespace meniscus
