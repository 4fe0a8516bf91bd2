// SPDX-License-Identifier: BSD-3-Clause
// How far points are from the triangles of a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "core/math/box_tree.h"

namespace meniscus {

/// Of a point: the nearest triangle (the number of triangles if none is near enough) and how far it is, in Å.
struct NearestTriangle {
  std::uint32_t triangle;
  double distance;
};

class MeshDistance {
 public:
  /// Positions in Å. Both have to live as long.
  MeshDistance(std::span<const glm::dvec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles);

  /// The nearest triangle of those nearer than `limit` Å. May be asked by several threads.
  NearestTriangle operator()(const glm::dvec3& x, double limit) const;

 private:
  std::array<glm::dvec3, 3> corners(std::uint32_t triangle) const;

  std::span<const glm::dvec3> positions_;
  std::span<const std::array<std::uint32_t, 3>> triangles_;
  BoxTree tree_;
};

}  // namespace meniscus
