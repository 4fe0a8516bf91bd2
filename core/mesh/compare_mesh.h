// SPDX-License-Identifier: BSD-3-Clause
// Compares a mesh with its surface by the areas and volumes of its triangles, and computes distances from points to
// triangles.
#pragma once

#include <string>

#include "core/math/box.h"
#include "core/mesh/triangle_mesh.h"

namespace meniscus {

/// Returns one sentence for each of the first eight differences that the mesh's tolerance t does not allow, and the
/// number of the others; nothing if there are none. The triangles of a face may differ from its area by 4 t over its
/// radius of curvature, relatively, and by a strip of width 2 t along its borders. The volume of a component may differ
/// by a layer 2 t thick. Both are far less than a sphere if t is well below the probe radius. `mesh` has all faces of
/// `surface`; none are hidden.
std::vector<std::string> differences(const Surface& surface, const TriangleMesh& mesh);

/// The triangle nearest to a point, and its distance in Å. `triangle` is the number of triangles if none is near.
struct NearestTriangle {
  std::uint32_t triangle;
  double distance;
};

/// Finds the triangles of a mesh that are near a point.
class MeshDistance {
 public:
  /// Positions are in Å. Both spans must outlive this object.
  MeshDistance(std::span<const glm::dvec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles);

  /// Returns the nearest of the triangles that are nearer than `limit` Å. Safe to call from several threads.
  NearestTriangle operator()(const glm::dvec3& x, double limit) const;
  /// Returns any triangle nearer than `limit` Å, or the number of triangles if there is none. Faster than finding the
  /// nearest one.
  std::uint32_t any_within(const glm::dvec3& x, double limit) const;
  /// Returns the distance (Å) from a point to this triangle.
  double to_triangle(const glm::dvec3& x, std::uint32_t triangle) const;

 private:
  std::array<glm::dvec3, 3> corners(std::uint32_t triangle) const;

  std::span<const glm::dvec3> positions_;
  std::span<const std::array<std::uint32_t, 3>> triangles_;
  BoxTree tree_;
};

}  // namespace meniscus
