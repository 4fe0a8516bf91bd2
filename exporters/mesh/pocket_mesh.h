// SPDX-License-Identifier: BSD-3-Clause
// Pockets as solids: one closed mesh for each, in a colour of its own.
#pragma once

#include <vector>

#include "core/pockets/pockets.h"
#include "exporters/mesh/ply.h"
#include "exporters/mesh/triangle_mesh.h"

namespace meniscus {

struct PocketMesh {
  /// Normals point out of the pockets, whose volumes are positive; `component` is the place in Pockets::pockets.
  TriangleMesh mesh;
  Coloring coloring;                ///< categorical_color() of that place
  std::vector<AtomScalar> scalars;  ///< "pocket": the rank, from 1
};

/// tolerance: Å. Throws what tessellate throws, CapacityError, RequestError if there are no pockets.
PocketMesh pocket_mesh(const Pockets& pockets, double tolerance);

}  // namespace meniscus
