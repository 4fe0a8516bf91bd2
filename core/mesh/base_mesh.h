// SPDX-License-Identifier: BSD-3-Clause
// Builds the closed meshes that even remeshing starts from.
#pragma once

#include "core/mesh/surface_walk.h"
#include "core/mesh/triangle_mesh.h"

namespace meniscus {

/// A closed mesh that even remeshing starts from.
struct BaseMesh {
  TriangleMesh mesh;                       ///< only `positions`, `triangles` and `face` are filled
  std::vector<std::uint32_t> vertex_face;  ///< per vertex: index into Surface::faces of a face that it lies on
};

enum class BaseMeshKind : std::uint8_t {
  contracted,  ///< contracted_mesh(): contact faces are contracted to points
  coarse,      ///< coarse_mesh(): the fewest triangles for all faces
  patches      ///< tessellate(): triangles that follow the patches
};

/// Builds a base mesh of this kind. Its components and their Euler characteristics are those of the surface. `walk`
/// bars no border. `tolerance` (Å) applies to BaseMeshKind::patches only; finer ones are tried where tessellation fails
/// at it. Throws OpenSurfaceError if no such mesh is found.
BaseMesh base_mesh(const Surface& surface, const SurfaceWalk& walk, BaseMeshKind kind, double tolerance);

/// Builds the mesh with the fewest triangles that has the topology of the surface. Each face becomes a polygon between
/// its vertices and, on long borders, samples. A polygon of three corners stays one triangle, the quadrilateral of a
/// saddle is split by a diagonal, and others become fans about a point of the face. Only a face that is none of these,
/// such as one with holes, is triangulated in its plane.
///
/// The mesh is closed and, except for folds at deep faces, oriented outward. Its vertices lie on the exact surface, and
/// its components and their Euler characteristics are those of the surface. The distance of triangles from the surface
/// is not bounded, and on degenerate surfaces such as lattices a few triangles may cross. Arcs of at most about `angle`
/// (radian) become one edge. Only `positions`, `triangles` and `face` of the result are filled. `walk` bars no border,
/// and the probe radius is above 0. Throws OpenSurfaceError if no such mesh is found. Two faces that both draw an edge
/// between the same two vertices are not detected here; HalfEdges refuses such a mesh.
TriangleMesh coarse_mesh(const Surface& surface, const SurfaceWalk& walk, double angle = 0.9);

/// Builds a mesh around the reduced surface by contracting contact faces to points. `coarse` is a result of
/// coarse_mesh(). A contact face that is a disc becomes its midpoint, and a saddle between two such discs becomes an
/// edge, unless the mesh would then not be closed or would have another topology. The mesh is closed, its vertices lie
/// on the exact surface, and its components and their Euler characteristics are those of the surface. The distance of
/// triangles from the surface is not bounded, and some triangles may cross. `walk` bars no border. Throws
/// OpenSurfaceError if the coarse mesh is not a manifold.
BaseMesh contracted_mesh(const Surface& surface, const SurfaceWalk& walk, const TriangleMesh& coarse);

}  // namespace meniscus
