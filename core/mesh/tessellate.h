// SPDX-License-Identifier: BSD-3-Clause
// Makes a closed triangle mesh of an exact surface.
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace meniscus {

/// Meshes every face of `surface` between shared samples of its borders, on all cores that TBB may use. The mesh is the
/// same for any number of threads. Throws Error if the tolerance is not a positive number or the edge length is
/// negative, and OpenSurfaceError if the result would not be closed or would not have the areas and volumes of the
/// surface (compare_mesh.h).
TriangleMesh tessellate(const Surface& surface, const MeshOptions& options = {});

}  // namespace meniscus
