// SPDX-License-Identifier: BSD-3-Clause
// Compares a mesh with its surface: areas and volumes of the triangles alone, and distances of points from
// them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/math/box.h"
#include "core/mesh/triangle_mesh.h"

namespace meniscus {

/// Every difference beyond what the mesh's tolerance t allows, in one sentence each; empty: equal. A face's triangles
/// have its area but for 4 t over its radius of curvature and, along its borders, a strip of width 2 t; the volume of a
/// component differs by no more than a layer 2 t thick. Both are far less than a sphere for t well below the probe.
/// mesh: of all faces of `surface`, nothing hidden.
std::vector<std::string> differences(const Surface& surface, const TriangleMesh& mesh);

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
  /// Any triangle nearer than `limit` Å, or the number of triangles: sooner found than the nearest.
  std::uint32_t any_within(const glm::dvec3& x, double limit) const;
  /// Å, to this triangle.
  double to_triangle(const glm::dvec3& x, std::uint32_t triangle) const;

 private:
  std::array<glm::dvec3, 3> corners(std::uint32_t triangle) const;

  std::span<const glm::dvec3> positions_;
  std::span<const std::array<std::uint32_t, 3>> triangles_;
  BoxTree tree_;
};

}  // namespace meniscus
