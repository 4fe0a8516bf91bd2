// SPDX-License-Identifier: BSD-3-Clause
// Computes a closed mesh of nearly equilateral triangles of an exact surface, at any density.
#pragma once

#include "core/mesh/remesh_tuning.h"

namespace meniscus {

struct FineMesh;

/// Remeshes a base mesh of the surface (base_mesh.h) into nearly equilateral triangles. The base is coarse_mesh(), or
/// contracted_mesh() for long edges, or tessellate() for short ones. Edges are split, collapsed and flipped, and
/// vertices move along the surface (Botsch & Kobbelt, "A remeshing approach to multiresolution modeling", 2004); each
/// vertex stays on the exact sphere or torus below it.
///
/// Triangles may cross the borders of patches; `kind`, `face`, `patch` and `atom` of a triangle are those of the exact
/// surface below its centroid. Edges follow creases that are not shorter than the edges. The mesh is closed, has the
/// components of the surface with their Euler characteristics, has no triangles that pass through others, and is the
/// same for any number of threads.
///
/// With a tolerance, the distance of each triangle from the surface is measured at 7 places, and the distance of the
/// surface from the mesh at the vertices of a tessellation of 0.3 tolerances. Between these places distances may be
/// larger, by an amount that is not bounded here: 1.46 tolerances were seen, at 5 of 140,000 points.
///
/// Where triangles pass through others, lie too far away or are slivers, the best of all small changes there is made,
/// repeatedly, while one helps; a few slivers may remain. If, with a density, a few triangles still cross, they are
/// refined. If that does not help, or triangles are too far away, remeshing restarts and keeps the triangles of the
/// base around such places, except for such small changes. After several restarts slivers may remain.
///
/// Throws Error for invalid numbers, and OpenSurfaceError if no such mesh is found. Where creases crowd, as on bare
/// balls, some tolerances are refused.
FineMesh even_mesh(const Surface& surface, const EvenMeshOptions& options = {});

}  // namespace meniscus
