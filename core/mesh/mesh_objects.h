// SPDX-License-Identifier: BSD-3-Clause
// The meshes of a molecule's objects, as fine as a picture needs them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "core/queries/surface_object.h"

namespace meniscus {

struct Camera;
struct TriangleMesh;

/// What a mesh may be asked for. With a smaller tolerance one of a protein no longer fits into memory, and float
/// coordinates could not hold it.
inline constexpr double kSmallestTolerance = 1e-5, kLargestTolerance = 1.0;  // Å
inline constexpr double kSmallestDensity = 0.005, kLargestDensity = 1000.0;  // vertices per Å², of even meshes

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

/// Of all of them.
std::size_t triangle_count(std::span<const TriangleMesh> meshes);

}  // namespace meniscus
