// SPDX-License-Identifier: BSD-3-Clause
// From an exact surface to a closed triangle mesh of it.
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace meniscus {

/// Meshes every face of `surface` between the shared samples of its borders; runs on all cores TBB may use.
/// The mesh is the same for any number of threads. Throws Error if the tolerance is not a positive number,
/// OpenSurfaceError if the result would not be closed, or its areas and volumes not those of the surface
/// (compare_mesh.h).
TriangleMesh tessellate(const Surface& surface, const MeshOptions& options = {});

}  // namespace meniscus
