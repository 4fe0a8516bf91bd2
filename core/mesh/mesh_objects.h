// SPDX-License-Identifier: BSD-3-Clause
// The meshes of a molecule's objects: their fineness, in Å or by a camera, and the number of triangles it gives.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace meniscus {

struct Ball;
struct Camera;
struct FineMesh;
struct Surface;
struct SurfaceObject;
struct TriangleMesh;

/// What a camera is for: nothing finer than this many pixels can be seen.
inline constexpr double kPixelsOfACamera = 0.5;

/// How far a mesh may be from the surface.
struct MeshRequest {
  double tolerance = 0.01;        ///< Å
  double tolerance_pixels = 0.0;  ///< > 0: of a picture, instead of Å
};

/// The tolerance in Å: as given, or what the pixels mean at the nearest ball in a picture of this size (pixels).
double tolerance_of(const MeshRequest& request, glm::ivec2 size, const Camera& camera, std::span<const Ball> balls);

/// Meshes what is shown of each object. Throws RequestError when no triangle came out.
std::vector<TriangleMesh> mesh_objects(std::span<const SurfaceObject> objects, double tolerance,
                                       bool may_be_empty = false);

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
