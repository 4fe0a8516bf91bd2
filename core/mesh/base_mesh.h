// SPDX-License-Identifier: BSD-3-Clause
// The closed meshes that even ones begin with.
#pragma once

#include <cstdint>

#include "core/mesh/contracted_mesh.h"
#include "core/mesh/surface_walk.h"

namespace meniscus {

/// What is remeshed.
enum class Beginning : std::uint8_t {
  contracted,  ///< contracted_mesh(): contact faces as points
  coarse,      ///< coarse_mesh(): the fewest triangles of all faces
  patches      ///< tessellate(): patch-aligned triangles
};

/// Components and their Euler characteristics are those of the surface. walk: nothing barred. tolerance: Å, of patches;
/// a finer one is taken where there is no such mesh. Throws OpenSurfaceError where there is none.
BaseMesh base_mesh(const Surface& surface, const SurfaceWalk& walk, Beginning beginning, double tolerance);

}  // namespace meniscus
