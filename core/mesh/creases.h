// SPDX-License-Identifier: BSD-3-Clause
// Borders at which faces meet at an angle, which of them a mesh of given edges has to follow, and which edges do.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/constants.h"
#include "core/mesh/half_edges.h"
#include "core/mesh/surface_walk.h"
#include "core/surface/primitives.h"

namespace meniscus {

struct TriangleMesh;

/// The unit normals at a point of a border on both sides of it: of a cusp between spheres of two probes, and, where the
/// probe has no size, of two balls. Twice the same (0) for other borders: tangent planes agree there.
std::array<glm::dvec3, 2> crease_normals(const Surface& surface, const Border& border, const glm::dvec3& x);

/// The angle (radian) between them, the same all along the border.
double crease_angle(const Surface& surface, const Border& border);

/// Per border whether triangles with edges this long (Å, at a place) should end at it: those that bridge it would be
/// farther from the surface than elsewhere (h sin(angle/2) / 4 against h²/(6 r)), and the crease is no shorter than an
/// edge.
std::vector<bool> creases_to_keep(const Surface& surface, const std::function<double(const glm::dvec3&)>& edge);

/// Tells the edges of `links`, which are those of the mesh, of the borders that they run along. keep: per border of the
/// surface whether it counts. mesh: `face` is filled in.
void mark_creases(const Surface& surface, const SurfaceWalk& walk, const TriangleMesh& mesh,
                  const std::vector<bool>& keep, HalfEdges& links);

/// What meets at a vertex.
struct CreaseAt {
  std::uint32_t border = kNone;  ///< one that edges at the vertex run along, or kNone
  bool ends = false;             ///< not two edges along one border: creases end or meet
};
std::vector<CreaseAt> creases_at_vertices(const HalfEdges& links);

}  // namespace meniscus
