// SPDX-License-Identifier: BSD-3-Clause
// How fine a mesh is to be, in Å or by a camera, how many triangles that makes, and the mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/math/ball.h"
#include "core/mesh/mesh_objects.h"

namespace meniscus {

struct Camera;
struct FineMesh;

/// What a mesh is to be like.
struct MeshFineness {
  double tolerance = 0.05;  ///< Å; the smallest, where it depends on the place
  /// Å at a point, for even meshes; empty: the same everywhere.
  std::function<double(const glm::dvec3&)> tolerance_at;
  double density = 0.0;  ///< > 0: vertices per Å², of an even mesh
  bool even = false;     ///< nearly equilateral triangles, which reach over borders of patches
};

/// Of a picture of this size (pixels). Pixels are those at each point, for an even mesh; for one that keeps to patches,
/// those at the nearest of the balls.
MeshFineness fineness_of(const MeshRequest& request, bool even, double density, glm::ivec2 size, const Camera& camera,
                         std::span<const Ball> balls);

/// About how many triangles the mesh of a surface gets, to a factor of two, without making it.
double estimated_triangles(const Surface& surface, const MeshFineness& fineness);

/// Throws what tessellate() or even_mesh() throw.
FineMesh fine_mesh(const Surface& surface, const MeshFineness& fineness);

}  // namespace meniscus
