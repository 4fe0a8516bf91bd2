// SPDX-License-Identifier: BSD-3-Clause
// The curvature of a mesh, averaged over a few Å around each vertex: that of bumps and clefts rather than of atoms.
#pragma once

#include <vector>

#include "core/queries/surface_point.h"

namespace meniscus {

struct TriangleMesh;

/// Å: how far around a vertex is averaged.
inline constexpr double kSmoothingRadius = 2.0;

/// One per vertex: curvature measures of the normal cycle (D. Cohen-Steiner and J.-M. Morvan, "Restricted Delaunay
/// triangulations and normal cycle", SoCG 2003, section 4: angles between triangles along edges, and what is missing of
/// 2 pi at vertices), added up over the vertices that lie within `radius` (Å) and can be reached along edges that do,
/// and divided by their area. Cusps count, too, with their angles. The mesh is closed. Runs on all cores TBB may use.
std::vector<Curvature> smoothed_curvatures(const TriangleMesh& mesh, double radius = kSmoothingRadius);

}  // namespace meniscus
