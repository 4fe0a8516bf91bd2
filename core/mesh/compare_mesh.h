// SPDX-License-Identifier: BSD-3-Clause
// A surface against a mesh of it: areas and volumes that come from triangles alone.
#pragma once

#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace meniscus {

/// Every difference beyond what the mesh's tolerance t allows, in one sentence each; empty: equal. A face's triangles
/// have its area but for 4 t over its radius of curvature and, along its borders, a strip of width 2 t; the volume of a
/// component differs by no more than a layer 2 t thick. Both are far less than a sphere for t well below the probe.
/// mesh: of all faces of `surface`, nothing hidden.
std::vector<std::string> differences(const Surface& surface, const TriangleMesh& mesh);

}  // namespace meniscus
