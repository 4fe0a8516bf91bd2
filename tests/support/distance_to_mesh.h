// SPDX-License-Identifier: BSD-3-Clause
// Distances of points from a mesh, computed by other code than the code under test.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "core/mesh/triangle_mesh.h"

namespace meniscus::testing {

/// Returns the largest distance of points from a mesh, Å. Vertices of a finer mesh give the surface's distance.
double farthest_from(const TriangleMesh& mesh, const std::vector<glm::dvec3>& points);

}  // namespace meniscus::testing
