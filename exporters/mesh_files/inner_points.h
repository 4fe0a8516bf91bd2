// SPDX-License-Identifier: BSD-3-Clause
// Finds a point inside each cavity and each solid, for programs that fill meshes.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

struct Surface;
struct TriangleMesh;

/// Returns one point per component of a surface. The point lies on the inner side of the component, which is the
/// solvent for a cavity and the solid otherwise, and on the inner side of its triangles. A ball around it touches this
/// component and contains nothing of the surface. If the triangles are too coarse for such a point, it lies on their
/// inner side only, close to one of them. mesh: the closed mesh of the whole surface. Throws OpenSurfaceError for a
/// component without such a point at any of the places tried.
std::vector<glm::dvec3> inner_points(const Surface& surface, const TriangleMesh& mesh);

}  // namespace meniscus
