// SPDX-License-Identifier: BSD-3-Clause
// A closed triangle mesh of the solvent-excluded surface, with the patch and the atom of each triangle.
#pragma once

#include "core/surface/primitives.h"

namespace meniscus {

struct Coloring;

/// The limits of the fineness that may be requested. With a smaller tolerance the mesh of a protein no longer fits into
/// memory, and single-precision coordinates cannot hold it.
inline constexpr double kSmallestTolerance = 1e-5, kLargestTolerance = 1.0;  // Å
inline constexpr double kSmallestDensity = 0.005, kLargestDensity = 1000.0;  // vertices per Å²; for even meshes

/// The fineness of the mesh that tessellate() makes.
struct MeshOptions {
  double tolerance = 0.01;  ///< Å: no point of the mesh is farther from the exact surface
  /// True: cut triangles where the nearest contact changes, so that colours change along edges.
  bool split_colors = true;
  /// If above 0, edges are about this long (Å), inside faces and along borders, and the mesh has the tolerance that
  /// results. Vertices of the surface remain, however near to each other they are.
  double edge = 0.0;
};

/// A triangle mesh as plain arrays. Every edge has exactly two triangles (except with partly_hidden), which traverse it
/// in opposite directions; triangles are counter-clockwise seen from the solvent. All vertices lie on the exact
/// surface.
struct TriangleMesh {
  std::vector<glm::dvec3> positions;  ///< Å
  std::vector<glm::dvec3> normals;    ///< unit and exact; at sharp vertices the mean of the normals around them
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// The numbers of vertices in the order of tessellate(): first the vertices of the surface, then the points of its
  /// borders. Both are 0 if triangles were left out.
  std::uint32_t corner_count = 0, border_point_count = 0;

  std::vector<std::uint32_t> face;       ///< per triangle: index into Surface::faces
  std::vector<PatchKind> kind;           ///< per triangle
  std::vector<std::uint32_t> patch;      ///< per triangle: index into the patch table of its kind
  std::vector<std::uint32_t> component;  ///< per triangle: index into Surface::components
  std::vector<std::uint32_t> atom;       ///< per triangle: the touched atom with the nearest contact

  /// The corners (3 * triangle + 0..2) at cusps, where a vertex has no single normal, ascending, and their exact
  /// normals.
  std::vector<std::uint32_t> sharp_corners;
  std::vector<glm::dvec3> sharp_corner_normals;
  std::vector<std::array<std::uint32_t, 2>> sharp_edges;  ///< vertex pairs along cusps

  double tolerance = 0.0;  ///< Å, as requested; with MeshOptions::edge the tolerance that results
  /// True if triangles were left out: edges along the border of the shown part have one triangle.
  bool partly_hidden = false;
};

/// A mesh with the face and the atom of each vertex.
struct FineMesh {
  TriangleMesh mesh;
  std::vector<std::uint32_t> vertex_face;  ///< index into Surface::faces: a face that the vertex lies on
  std::vector<std::uint32_t> vertex_atom;  ///< index into Surface::atoms: the touched atom with the nearest contact
  std::uint32_t attempts = 0;              ///< number of attempts that an even mesh took
};

/// Returns for each vertex of a mesh that follows patches the face of the first of its triangles.
std::vector<std::uint32_t> vertex_faces(const TriangleMesh& mesh);

/// Measures of a triangle mesh, or of one component of it.
struct MeshMeasure {
  std::size_t vertex_count = 0;
  std::size_t edge_count = 0;
  std::size_t triangle_count = 0;
  double area = 0.0;    ///< Å²
  double volume = 0.0;  ///< Å³, signed: negative for a cavity, whose triangles face inwards
  bool closed = false;  ///< true if every edge has two triangles that traverse it in opposite directions
  int euler() const { return int(vertex_count) - int(edge_count) + int(triangle_count); }
};

/// Removes the triangles that `keep` does not mark, and the vertices that only they use. Returns the new number of each
/// vertex, kNone for those removed. `changed` marks triangles with corners that sharp_corners no longer describes;
/// empty if there are none.
std::vector<std::uint32_t> keep_triangles(TriangleMesh& mesh, const std::vector<bool>& keep,
                                          const std::vector<bool>& changed = {});

/// Returns the triangles of shown atoms with the vertices that they use; all triangles if no atom is hidden. The mesh
/// must have been split at colours, so that it ends where shown and hidden atoms are equally near.
TriangleMesh shown_part(TriangleMesh mesh, const Coloring& coloring);

/// Sums over triangles, added up in their order.
struct MeshSums {
  std::size_t triangle_count = 0;
  double area = 0.0;    ///< Å²
  double volume = 0.0;  ///< Å³, signed as in MeshMeasure
};
MeshSums sums_of(const TriangleMesh& mesh);
/// Returns the sums for each of the surface's components.
std::vector<MeshSums> component_sums(const TriangleMesh& mesh, std::size_t component_count);

/// Measures the triangles of one component, or of all if `component` is kNone.
MeshMeasure measure(const TriangleMesh& mesh, std::uint32_t component = kNone);

}  // namespace meniscus
