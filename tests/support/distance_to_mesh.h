// SPDX-License-Identifier: BSD-3-Clause
// Distances of points from a mesh, computed by other code than the code under test.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "core/mesh/triangle_mesh.h"

namespace meniscus::testing {

/// The largest distance of points from a mesh, Å. Of vertices of a finer mesh: how far the surface is from this one.
double farthest_from(const TriangleMesh& mesh, const std::vector<glm::dvec3>& points);

}  // namespace meniscus::testing
