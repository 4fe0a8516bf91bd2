// SPDX-License-Identifier: BSD-3-Clause
// A mesh of a surface with contact faces drawn together to points: about the reduced surface.
#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh/surface_walk.h"
#include "core/mesh/triangle_mesh.h"

namespace meniscus {

/// A closed mesh that an even one begins with.
struct BaseMesh {
  TriangleMesh mesh;                       ///< `positions`, `triangles` and `face` are filled in
  std::vector<std::uint32_t> vertex_face;  ///< per vertex: into Surface::faces, one that it lies on
};

/// coarse: of coarse_mesh(). Contact faces that are discs become their middles, saddles between two such ones edges,
/// unless the mesh would not be closed, or of another topology, without them. Closed, vertices on the exact surface,
/// components and their Euler characteristics those of the surface. No bound on how far triangles are from it; some may
/// cross. walk: nothing barred. Throws OpenSurfaceError where the coarse mesh is no manifold.
BaseMesh contracted_mesh(const Surface& surface, const SurfaceWalk& walk, const TriangleMesh& coarse);

}  // namespace meniscus
