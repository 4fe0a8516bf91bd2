// SPDX-License-Identifier: BSD-3-Clause
// Pockets as solids: one closed mesh for each.
#pragma once

#include "core/pockets/pockets.h"

namespace meniscus {

struct TriangleMesh;

/// All of them in one mesh. Normals point out of the pockets, whose volumes are positive; `component` is the place in
/// Pockets::pockets, `atom` says nothing. tolerance: Å. Throws what tessellate throws, CapacityError, RequestError if
/// there are no pockets.
TriangleMesh pocket_mesh(const Pockets& pockets, double tolerance);

}  // namespace meniscus
