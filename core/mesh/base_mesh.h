// SPDX-License-Identifier: BSD-3-Clause
// The closed meshes from which even ones are made by splitting and collapsing edges.
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

/// What is remeshed.
enum class Beginning : std::uint8_t {
  contracted,  ///< contracted_mesh(): contact faces as points
  coarse,      ///< coarse_mesh(): the fewest triangles of all faces
  patches      ///< tessellate(): patch-aligned triangles
};

/// Components and their Euler characteristics are those of the surface. walk: nothing barred. tolerance: Å, of patches;
/// a finer one is taken where there is no such mesh. Throws OpenSurfaceError where there is none.
BaseMesh base_mesh(const Surface& surface, const SurfaceWalk& walk, Beginning beginning, double tolerance);

/// The fewest triangles that have a surface's topology. Each face is a polygon between its vertices (and samples of
/// long borders): a triangle stays one, a saddle's quadrangle gets a diagonal, others are fans about a point of the
/// face; only what is none of that, as a face with holes, is triangulated in its plane. Closed, outward but for folds
/// at deep faces, vertices on the exact surface, components and their Euler characteristics those of the surface. No
/// bound on how far triangles are from it, and of degenerate surfaces, as lattices, a few may cross. Arcs that span no
/// more than about `angle` (radian) are one edge. Of the result `positions`, `triangles` and `face` are filled in.
/// walk: nothing barred. The probe needs a size. Throws OpenSurfaceError where no such mesh was found; two faces that
/// draw an edge between the same two vertices are left to HalfEdges to refuse.
TriangleMesh coarse_mesh(const Surface& surface, const SurfaceWalk& walk, double angle = 0.9);

/// A mesh about the reduced surface: contact faces drawn together to points. coarse: of coarse_mesh(). Contact faces
/// that are discs become their middles, saddles between two such ones edges, unless the mesh would not be closed, or of
/// another topology, without them. Closed, vertices on the exact surface, components and their Euler characteristics
/// those of the surface. No bound on how far triangles are from it; some may cross. walk: nothing barred. Throws
/// OpenSurfaceError where the coarse mesh is not a manifold.
BaseMesh contracted_mesh(const Surface& surface, const SurfaceWalk& walk, const TriangleMesh& coarse);

}  // namespace meniscus
