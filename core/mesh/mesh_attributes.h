// SPDX-License-Identifier: BSD-3-Clause
// The curvature of a mesh, averaged over a few Å around each vertex: that of bumps and clefts rather than of atoms.
#pragma once

#include <vector>

#include "core/queries/surface_point.h"

namespace meniscus {

struct TriangleMesh;

/// The radius (Å) around a vertex over which curvature is averaged.
inline constexpr double kSmoothingRadius = 2.0;

/// Returns the averaged curvature at each vertex of a closed mesh. The curvature measures of the normal cycle (D.
/// Cohen-Steiner and J.-M. Morvan, "Restricted Delaunay triangulations and normal cycle", SoCG 2003, section 4: angles
/// between triangles along edges, and angle deficits to 2 pi at vertices) are summed over the vertices that lie within
/// `radius` (Å) and can be reached along edges between such vertices, and divided by their area. Cusps count, too, with
/// their angles. Runs on all cores that TBB may use.
std::vector<Curvature> smoothed_curvatures(const TriangleMesh& mesh, double radius = kSmoothingRadius);

}  // namespace meniscus
