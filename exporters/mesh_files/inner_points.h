// SPDX-License-Identifier: BSD-3-Clause
// A point inside each cavity and each solid, for programs that fill meshes.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

struct Surface;
struct TriangleMesh;

/// One per component: on its inner side, in a cavity in the solvent and else in the solid, with a ball around it that
/// touches this component of the surface and holds nothing of it; and on the inner side of its triangles. Where these
/// are so coarse that there is none of both, on their inner side alone, close to one of them. mesh: of all of the
/// surface, closed. Throws OpenSurfaceError for a component with no such point at any of the places tried.
std::vector<glm::dvec3> inner_points(const Surface& surface, const TriangleMesh& mesh);

}  // namespace meniscus
