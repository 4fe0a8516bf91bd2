// SPDX-License-Identifier: BSD-3-Clause
// A closed triangle mesh of the solvent-excluded surface, and what each of its triangles belongs to.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus {

struct Coloring;

/// What a mesh may be asked for. With a smaller tolerance one of a protein no longer fits into memory, and float
/// coordinates could not hold it.
inline constexpr double kSmallestTolerance = 1e-5, kLargestTolerance = 1.0;  // Å
inline constexpr double kSmallestDensity = 0.005, kLargestDensity = 1000.0;  // vertices per Å², of even meshes

struct MeshOptions {
  double tolerance = 0.01;   ///< Å: no point of the mesh is farther from the exact surface
  bool split_colors = true;  ///< cut triangles where the nearest contact changes, so colours change along edges
  /// Å; above 0: edges are about this long, inside faces and along borders, and whatever tolerance that comes to is the
  /// mesh's. Vertices of the surface stay, however near to each other.
  double edge = 0.0;
};

/// Plain arrays. Every edge has exactly two triangles (but see partly_hidden), which walk it in opposite directions;
/// seen from the solvent triangles are counter-clockwise. All vertices lie on the exact surface.
struct TriangleMesh {
  std::vector<glm::dvec3> positions;  ///< Å
  std::vector<glm::dvec3> normals;    ///< unit, exact; at sharp vertices the mean of the normals around them
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// As tessellate() numbers them: so many vertices of the surface first, then so many points of its borders. Both 0
  /// where triangles were left out.
  std::uint32_t corner_count = 0, border_point_count = 0;

  std::vector<std::uint32_t> face;       ///< per triangle: into Surface::faces
  std::vector<PatchKind> kind;           ///< per triangle
  std::vector<std::uint32_t> patch;      ///< per triangle: into the patch table of its kind
  std::vector<std::uint32_t> component;  ///< per triangle: into Surface::components
  std::vector<std::uint32_t> atom;       ///< per triangle: the touched atom whose contact is nearest

  /// Corners (3*triangle + 0..2) at cusps, where the vertex has no single normal, ascending; and their exact normals.
  std::vector<std::uint32_t> sharp_corners;
  std::vector<glm::dvec3> sharp_corner_normals;
  std::vector<std::array<std::uint32_t, 2>> sharp_edges;  ///< vertex pairs along cusps

  double tolerance = 0.0;      ///< Å, as asked; with MeshOptions::edge what that comes to
  bool partly_hidden = false;  ///< triangles were left out: edges along the border of what is shown have one triangle
};

/// A mesh, and what its vertices belong to.
struct FineMesh {
  TriangleMesh mesh;
  std::vector<std::uint32_t> vertex_face;  ///< into Surface::faces: one that the vertex lies on
  std::vector<std::uint32_t> vertex_atom;  ///< into Surface::atoms: the touched one whose contact is nearest
  std::uint32_t attempts = 0;              ///< of an even mesh: how often it was begun
};

/// Of each vertex of a mesh that keeps to patches, the face of the first of its triangles.
std::vector<std::uint32_t> vertex_faces(const TriangleMesh& mesh);

/// Measures of a triangle mesh, or of one component of it.
struct MeshMeasure {
  std::size_t vertex_count = 0;
  std::size_t edge_count = 0;
  std::size_t triangle_count = 0;
  double area = 0.0;    ///< Å²
  double volume = 0.0;  ///< Å³, signed: negative for a cavity, whose triangles face inwards
  bool closed = false;  ///< every edge has two triangles that walk it in opposite directions
  int euler() const { return int(vertex_count) - int(edge_count) + int(triangle_count); }
};

/// Leaves out the triangles that `keep` does not mark, and the vertices that only they use; returns the new place of
/// each vertex, kNone for those left out. changed: triangles whose corners are not those of sharp_corners any more;
/// empty: none.
std::vector<std::uint32_t> keep_triangles(TriangleMesh& mesh, const std::vector<bool>& keep,
                                          const std::vector<bool>& changed = {});

/// The triangles whose atoms are shown, with the vertices they use; all of them when none is hidden. The mesh must have
/// been split at colours, so that it ends where shown and hidden atoms are equally near.
TriangleMesh shown_part(TriangleMesh mesh, const Coloring& coloring);

/// What triangles add up to, in their order.
struct MeshSums {
  std::size_t triangle_count = 0;
  double area = 0.0;    ///< Å²
  double volume = 0.0;  ///< Å³, signed as in MeshMeasure
};
MeshSums sums_of(const TriangleMesh& mesh);
/// One for each of the surface's components.
std::vector<MeshSums> component_sums(const TriangleMesh& mesh, std::size_t component_count);

/// Measures the triangles of one component, or of all when `component` is kNone.
MeshMeasure measure(const TriangleMesh& mesh, std::uint32_t component = kNone);

}  // namespace meniscus
