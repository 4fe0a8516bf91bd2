// SPDX-License-Identifier: BSD-3-Clause
// Checks that an even mesh is within the tolerance of its surface, and the surface within that of the mesh.
#pragma once

#include <mutex>

#include "core/mesh/base_mesh.h"
#include "core/mesh/mesh_mender.h"
#include "core/mesh/remesh_tuning.h"
#include "core/queries/distance.h"

namespace meniscus {

/// Returns the point of the surface below x, a point of a triangle of the mesh, by walks that start at the faces of its
/// corners; nothing if no walk arrives.
std::optional<SurfacePoint> below(const MeshOnSurface& mesh, const glm::dvec3& x,
                                  const std::array<std::uint32_t, 3>& corners);

/// Measures the distances between an even mesh and its surface.
class MeshNearness {
 public:
  /// All three arguments must outlive this object.
  MeshNearness(const Surface& surface, const SurfaceWalk& walk, const EvenSizes& sizes)
      : surface_(surface), walk_(walk), sizes_(sizes) {}

  /// Requires the mesh to come near the vertices and centroids of this one, and near places along creases, which
  /// coarser meshes bridge.
  void set_targets(const BaseMesh& base);
  /// Returns a place of a triangle that is too far from the surface; nothing if there is none. Safe to call from
  /// several threads.
  std::optional<glm::dvec3> find_far_place(const MeshOnSurface& mesh, const PlacedTriangle& triangle) const;
  /// Returns the triangles that are too far from the surface, and those nearest to places that are too far from the
  /// mesh; away from creases neither occurs without the other. Each has the point of the surface that it should reach,
  /// if that is known; triangles are in ascending order. Triangles that did not change since the last call are known to
  /// be near the surface.
  std::vector<PointAtTriangle> find_far_triangles(MeshOnSurface& mesh);
  /// True if the mesh is also near the vertices of a fine one. Otherwise, from now on, it has to reach the vertices
  /// that it is far from.
  bool reaches_fine_vertices(const MeshOnSurface& mesh);

 private:
  SurfacePoint nearest_point(const MeshOnSurface& mesh, const glm::dvec3& x,
                             const std::array<std::uint32_t, 3>& corners) const;
  void add_bridges(const MeshOnSurface& mesh, std::vector<PointAtTriangle>& points);
  const SurfaceDistance& distance() const;
  const std::vector<SurfacePoint>& fine_vertices();

  const Surface& surface_;
  const SurfaceWalk& walk_;
  const EvenSizes& sizes_;
  std::vector<SurfacePoint> targets_;  ///< places that the mesh has to come near
  /// Per target: the key of a triangle that was near it; 0: none is known.
  std::vector<std::uint64_t> near_keys_;
  std::vector<SurfacePoint> fine_vertices_;  ///< computed on first use
  mutable std::once_flag distance_made_;
  mutable std::optional<SurfaceDistance> distance_;
};

}  // namespace meniscus
