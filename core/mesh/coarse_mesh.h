// SPDX-License-Identifier: BSD-3-Clause
// The fewest triangles that have a surface's topology: something to be split and collapsed until it is even.
#pragma once

#include "core/mesh/surface_walk.h"
#include "core/mesh/triangle_mesh.h"

namespace meniscus {

/// Each face is a polygon between its vertices (and samples of long borders): a triangle stays one, a saddle's
/// quadrangle gets a diagonal, others are fans about a point of the face; only what is none of that, as a face with
/// holes, is triangulated in its plane. Closed, outward but for folds at deep faces, vertices on the exact surface,
/// components and their Euler characteristics those of the surface. No bound on how far triangles are from it,
/// and of degenerate surfaces, as lattices, a few may cross.
/// Arcs that span no more than about `angle` (radian) are one edge. Of the result `positions`, `triangles` and `face`
/// are filled in. walk: nothing barred. The probe needs a size. Throws OpenSurfaceError where no such mesh was found;
/// two faces that draw an edge between the same two vertices are left to HalfEdges to refuse.
TriangleMesh coarse_mesh(const Surface& surface, const SurfaceWalk& walk, double angle = 0.9);

}  // namespace meniscus
