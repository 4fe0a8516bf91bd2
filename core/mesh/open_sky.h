// SPDX-License-Identifier: BSD-3-Clause
// What a surface sees of the sky, at the vertices of its mesh and as means over atoms: ambient occlusion as numbers.
#pragma once

#include <vector>

namespace meniscus {

struct Surface;
struct TriangleMesh;

/// sky_visibility() at each vertex of a mesh of the surface.
std::vector<float> vertex_open_sky(const Surface& surface, const TriangleMesh& mesh);

/// For each of Surface::atoms the mean of that over its triangles, by area; 0 where it has none.
std::vector<double> atom_open_sky(const Surface& surface, const TriangleMesh& mesh);

}  // namespace meniscus
