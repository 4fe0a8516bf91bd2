// SPDX-License-Identifier: BSD-3-Clause
// From an exact surface to a closed mesh of nearly equilateral triangles, at any density down to a few per atom.
#pragma once

#include "core/mesh/even_sizes.h"

namespace meniscus {

struct FineMesh;

/// Remeshes the fewest triangles that have the surface's topology (coarse_mesh()), for long edges with contact faces as
/// points (contracted_mesh()), for short ones those of tessellate(): edges are split, collapsed and flipped, vertices
/// move along the surface (Botsch & Kobbelt, "A remeshing approach to multiresolution modeling", 2004), and each stays
/// on the exact sphere or torus below it. Triangles reach over borders of patches; `kind`, `face`, `patch` and `atom`
/// of a triangle are those of the exact surface under its middle. Edges follow creases that are no shorter than they
/// are. The mesh is closed, has the surface's components and their Euler characteristics, no triangles that pass
/// through others, and is the same for any number of threads. With a tolerance the distance of each triangle from the
/// surface is measured at 7 places, and that of the surface from the mesh at the vertices of one as near as 0.3
/// tolerances; between those it may be larger, by an amount that is not bounded here (1.46 tolerances were seen, at 5
/// of 140,000 points). Where triangles pass through others, lie too far away or are slivers, the best of all small
/// changes there is made, again and again, as long as one helps: a few slivers may stay. Where a few triangles still
/// cross, with a density, they become smaller; where that does not help, or triangles are too far away, all begins
/// again, and what is around such places keeps to the triangles of the beginning, but for such changes; after several
/// times slivers may stay. Throws Error for numbers that are not valid, OpenSurfaceError where no such mesh was found:
/// where creases crowd, as on bare balls, a tolerance is refused at times.
FineMesh even_mesh(const Surface& surface, const EvenMeshOptions& options = {});

}  // namespace meniscus
