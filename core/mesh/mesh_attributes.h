// SPDX-License-Identifier: BSD-3-Clause
// Numbers of mesh vertices: the curvature averaged around them, and the part of the sky that they see.
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

/// Returns sky_visibility() at each vertex of a mesh of the surface.
std::vector<float> vertex_open_sky(const Surface& surface, const TriangleMesh& mesh);

/// Returns for each of Surface::atoms the mean of that over its triangles, weighted by area; 0 for atoms without
/// triangles.
std::vector<double> atom_open_sky(const Surface& surface, const TriangleMesh& mesh);

}  // namespace meniscus
