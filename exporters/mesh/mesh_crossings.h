// SPDX-License-Identifier: BSD-3-Clause
// Triangles of a mesh that pass through one another.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

/// All pairs of triangles that have a point in common other than a vertex or edge that both have, in ascending order.
/// Decided by signs of volumes in double precision. Runs on all cores TBB may use.
std::vector<std::pair<std::uint32_t, std::uint32_t>> crossing_triangles(
    std::span<const glm::dvec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace meniscus
