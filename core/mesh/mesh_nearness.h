// SPDX-License-Identifier: BSD-3-Clause
// Checks that an even mesh is as near to its surface as asked, and the surface to the mesh.
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/mesh/base_mesh.h"
#include "core/mesh/even_sizes.h"
#include "core/mesh/mesh_mender.h"
#include "core/queries/distance.h"

namespace meniscus {

/// The point of the surface under one of a triangle of the mesh, as its corners lead there.
std::optional<SurfacePoint> below(const MeshOnSurface& mesh, const glm::dvec3& x,
                                  const std::array<std::uint32_t, 3>& corners);

class MeshNearness {
 public:
  /// All three have to live as long.
  MeshNearness(const Surface& surface, const SurfaceWalk& walk, const EvenSizes& sizes)
      : surface_(surface), walk_(walk), sizes_(sizes) {}

  /// From now on the mesh has to come near the vertices and the middles of this one, and near places along creases,
  /// which coarser meshes bridge.
  void ask_for(const BaseMesh& base);
  /// A place of a triangle that is too far from the surface.
  std::optional<glm::dvec3> far_place(const MeshOnSurface& mesh, const PlacedTriangle& triangle) const;
  /// Triangles that are too far from the surface, and those nearest to places that are too far from the mesh: away from
  /// creases neither is without the other. With the point that they should reach, as far as it is known; ascending. Of
  /// triangles that did not change since this was asked last, the first are known to be near.
  std::vector<PointAtTriangle> too_far(MeshOnSurface& mesh);
  /// Is the mesh near the vertices of a fine one as well? Others have to be reached from now on.
  bool reaches_all(const MeshOnSurface& mesh);

 private:
  SurfacePoint near(const MeshOnSurface& mesh, const glm::dvec3& x, const std::array<std::uint32_t, 3>& corners) const;
  void add_bridges(const MeshOnSurface& mesh, std::vector<PointAtTriangle>& points);
  const SurfaceDistance& distance() const;
  const std::vector<SurfacePoint>& fine_vertices();

  const Surface& surface_;
  const SurfaceWalk& walk_;
  const EvenSizes& sizes_;
  std::vector<SurfacePoint> to_reach_;
  std::vector<std::uint64_t> near_;  ///< per place to reach, the key of a triangle that was near it; 0: none known
  std::vector<SurfacePoint> fine_vertices_;  ///< made when it is asked for first
  mutable std::once_flag distance_made_;
  mutable std::optional<SurfaceDistance> distance_;
};

}  // namespace meniscus
