// SPDX-License-Identifier: BSD-3-Clause
// Ambient occlusion as numbers: how much of the sky a surface sees at the vertices of its mesh, and means of it over
// atoms.
#pragma once

#include <vector>

namespace meniscus {

struct Surface;
struct TriangleMesh;

/// Returns sky_visibility() at each vertex of a mesh of the surface.
std::vector<float> vertex_open_sky(const Surface& surface, const TriangleMesh& mesh);

/// Returns for each of Surface::atoms the mean of that over its triangles, weighted by area; 0 for atoms without
/// triangles.
std::vector<double> atom_open_sky(const Surface& surface, const TriangleMesh& mesh);

}  // namespace meniscus
