// SPDX-License-Identifier: BSD-3-Clause
// Places on the surface where a vertex of a mesh may be put: below the middle of an edge, or of what is around it.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include "core/mesh/mesh_on_surface.h"

namespace meniscus {

/// Below the middle of an edge, of a crease on it; nothing where the surface is another sheet there.
std::optional<SurfacePoint> edge_middle(const MeshOnSurface& mesh, std::uint32_t half);

/// Of a vertex on a crease, the middle of its neighbours along it; nothing unless there are two.
std::optional<glm::dvec3> crease_middle(const MeshOnSurface& mesh, std::uint32_t vertex);

/// Of the triangles around a vertex, the mean of their centroids by area: what Lloyd's algorithm moves to.
glm::dvec3 centroid_around(const MeshOnSurface& mesh, std::uint32_t vertex);

/// Where relaxation moves a vertex; nothing if it stays, as where its triangles would become poor.
std::optional<SurfacePoint> relaxed(const MeshOnSurface& mesh, std::uint32_t vertex);

}  // namespace meniscus
