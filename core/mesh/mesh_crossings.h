// SPDX-License-Identifier: BSD-3-Clause
// Triangles of a mesh that pass through one another.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "core/math/box_tree.h"

namespace meniscus {

/// A triangle by the numbers of its vertices and where these are (Å).
struct PlacedTriangle {
  std::array<std::uint32_t, 3> vertex{};
  std::array<glm::dvec3, 3> at{};

  Box box() const { return {glm::min(glm::min(at[0], at[1]), at[2]), glm::max(glm::max(at[0], at[1]), at[2])}; }
};

/// Have these a point in common other than a vertex or edge that both have? Decided by signs of volumes in double
/// precision.
bool triangles_cross(const PlacedTriangle& a, const PlacedTriangle& b);

/// All pairs of triangles that have a point in common other than a vertex or edge that both have, in ascending order.
/// Runs on all cores TBB may use.
std::vector<std::pair<std::uint32_t, std::uint32_t>> crossing_triangles(
    std::span<const glm::dvec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace meniscus
