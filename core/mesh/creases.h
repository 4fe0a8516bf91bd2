// SPDX-License-Identifier: BSD-3-Clause
// Creases, the borders where faces meet at an angle: finds those that a mesh of given edges should follow, and the
// edges that run along them.
#pragma once

#include "core/base/constants.h"
#include "core/mesh/half_edges.h"
#include "core/mesh/surface_walk.h"
#include "core/surface/primitives.h"

namespace meniscus {

struct TriangleMesh;

/// Returns the unit normals on both sides of a border at its point x. They differ on a cusp between the spheres of two
/// probes and, if the probe radius is 0, between two balls. For other borders, where the tangent planes agree, both are
/// the zero vector.
std::array<glm::dvec3, 2> crease_normals(const Surface& surface, const Border& border, const glm::dvec3& x);

/// Returns the angle (radian) between the two normals, which is the same all along the border.
double crease_angle(const Surface& surface, const Border& border);

/// Returns for each border true if triangles with edges this long (`edge`: Å at a place) should end at it. This is so
/// if triangles that bridge the border would be farther from the surface than elsewhere, h sin(angle/2) / 4 against
/// h²/(6 r), and if the crease is not shorter than an edge.
std::vector<bool> creases_to_keep(const Surface& surface, const std::function<double(const glm::dvec3&)>& edge);

/// Sets HalfEdges::crease() of the edges of `links` that run along a border. `links` are the edges of `mesh`, of which
/// `face` is filled. `keep` is true for each border of the surface that counts as a crease.
void mark_creases(const Surface& surface, const SurfaceWalk& walk, const TriangleMesh& mesh,
                  const std::vector<bool>& keep, HalfEdges& links);

/// The crease at a vertex.
struct CreaseAt {
  std::uint32_t border = kNone;  ///< a border that edges at the vertex run along, or kNone
  bool ends = false;  ///< true if creases end or meet here: the crease edges are not just two along one border
};
/// Returns the crease at each vertex.
std::vector<CreaseAt> creases_at_vertices(const HalfEdges& links);

}  // namespace meniscus
