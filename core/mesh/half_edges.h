// SPDX-License-Identifier: BSD-3-Clause
// The half-edge structure of triangle meshes, with splits, collapses and flips of edges that keep the topology.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/base/constants.h"

namespace meniscus {

/// Lists the corners (3 * triangle + 0..2) at each vertex, ascending. The triangles need not form a manifold.
class CornerLists {
 public:
  CornerLists(std::span<const std::array<std::uint32_t, 3>> triangles, std::uint32_t vertex_count);

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(first_.size() - 1); }
  std::span<const std::uint32_t> at(std::uint32_t vertex) const {
    return {corners_.data() + first_[vertex], first_[vertex + 1] - first_[vertex]};
  }

 private:
  std::vector<std::uint32_t> first_;  ///< per vertex: the start of its corners in corners_, followed by their end
  std::vector<std::uint32_t> corners_;
};

/// True if the triangles at these corners of one vertex form a single closed fan around it; false for fewer than three.
bool is_closed_fan(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const std::uint32_t> corners);

/// A half-edge structure. Half-edge 3 t + k of triangle t goes from its corner k to corner (k + 1) % 3. Triangles and
/// vertices that were removed keep their numbers until compact().
class HalfEdges {
 public:
  /// Links a closed mesh, in which each edge has two triangles that traverse it in opposite directions. Throws
  /// OpenSurfaceError for any other mesh.
  HalfEdges(std::span<const std::array<std::uint32_t, 3>> triangles, std::uint32_t vertex_count);
  /// Links some triangles of a mesh; `corners` are the corners of these. A half-edge without exactly one reverse
  /// half-edge has no twin (kNone). Only vertices with a closed fan (is_closed_fan()) may be queried or changed.
  static HalfEdges of_part(std::span<const std::array<std::uint32_t, 3>> triangles, const CornerLists& corners);

  static std::uint32_t next(std::uint32_t half) { return half % 3 == 2 ? half - 2 : half + 1; }
  static std::uint32_t last(std::uint32_t half) { return half % 3 == 0 ? half + 2 : half - 1; }
  std::uint32_t half_edge_count() const { return static_cast<std::uint32_t>(from_.size()); }
  std::uint32_t triangle_count() const { return half_edge_count() / 3; }
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(leaving_.size()); }
  bool is_alive(std::uint32_t half) const { return from_[half] != kNone; }
  bool is_vertex_alive(std::uint32_t vertex) const { return leaving_[vertex] != kNone; }
  std::uint32_t from(std::uint32_t half) const { return from_[half]; }
  std::uint32_t to(std::uint32_t half) const { return from_[next(half)]; }
  std::uint32_t opposite(std::uint32_t half) const { return from_[last(half)]; }
  std::uint32_t twin(std::uint32_t half) const { return twin_[half]; }
  /// Returns a half-edge that leaves the vertex, or kNone if the vertex was removed.
  std::uint32_t leaving(std::uint32_t vertex) const { return leaving_[vertex]; }
  std::array<std::uint32_t, 3> corners(std::uint32_t triangle) const {
    return {from_[3 * triangle], from_[3 * triangle + 1], from_[3 * triangle + 2]};
  }
  /// Returns the border of the surface that the edge runs along, or kNone. It is the same for both half-edges.
  std::uint32_t crease(std::uint32_t half) const { return crease_[half]; }
  void set_crease(std::uint32_t half, std::uint32_t border) { crease_[half] = crease_[twin_[half]] = border; }

  /// Calls visit(half-edge) for the half-edges that leave a vertex, clockwise.
  template <typename Visit>
  void for_each_leaving(std::uint32_t vertex, const Visit& visit) const {
    const std::uint32_t first = leaving_[vertex];
    std::uint32_t half = first;
    do {
      visit(half);
      half = next(twin_[half]);
    } while (half != first);
  }
  /// True if the predicate holds for each half-edge that leaves a vertex. Stops at the first for which it does not.
  template <typename Predicate>
  bool all_leaving(std::uint32_t vertex, const Predicate& is_so) const {
    const std::uint32_t first = leaving_[vertex];
    std::uint32_t half = first;
    do {
      if (!is_so(half)) return false;
      half = next(twin_[half]);
    } while (half != first);
    return true;
  }
  std::uint32_t valence(std::uint32_t vertex) const {
    std::uint32_t count = 0;
    for_each_leaving(vertex, [&](std::uint32_t) { ++count; });
    return count;
  }
  /// Returns a half-edge from one vertex to another, or kNone.
  std::uint32_t between(std::uint32_t from, std::uint32_t to) const;

  /// Inserts a new vertex on an edge, and returns it. Both halves keep the crease.
  std::uint32_t split(std::uint32_t half);
  /// Inserts a new vertex into a triangle, and returns it.
  std::uint32_t poke(std::uint32_t triangle);
  /// Inverts poke(): removes the vertex opposite to a half-edge, which has valence 3. The triangle of the half-edge
  /// remains and covers all three.
  void unpoke(std::uint32_t half);
  /// True if the surface remains closed, with the same topology, when this edge is collapsed.
  bool can_collapse(std::uint32_t half) const;
  /// Merges the first vertex of an edge into its second. The first vertex and two triangles are removed.
  void collapse(std::uint32_t half);
  /// True if the edge is not a crease and the other diagonal would be a new edge.
  bool can_flip(std::uint32_t half) const;
  /// Replaces an edge by the other diagonal of its two triangles.
  void flip(std::uint32_t half);
  /// Rotates the numbers of a triangle's half-edges so that this one is the first.
  void put_first(std::uint32_t half);

  /// Renumbers the remaining vertices and triangles in order; returns the old number of each vertex.
  std::vector<std::uint32_t> compact();

 private:
  enum class Open : std::uint8_t { refused, allowed };
  HalfEdges(std::span<const std::array<std::uint32_t, 3>> triangles, const CornerLists& corners, Open open);
  void link(std::uint32_t a, std::uint32_t b, std::uint32_t crease) {
    twin_[a] = b;
    twin_[b] = a;
    crease_[a] = crease_[b] = crease;
  }

  std::vector<std::uint32_t> from_;     // per half-edge: its start; kNone: its triangle was removed
  std::vector<std::uint32_t> twin_;     // per half-edge: its reverse, or kNone
  std::vector<std::uint32_t> crease_;   // per half-edge: the border that it runs along, or kNone
  std::vector<std::uint32_t> leaving_;  // per vertex: a half-edge that leaves it; kNone: it was removed
};

/// Counts of the neighbours of two vertices.
struct CommonNeighbors {
  std::uint32_t common = 0;  ///< number of vertices that are neighbours of both
  std::uint32_t sum = 0;     ///< sum of the numbers of neighbours of each
};
CommonNeighbors common_neighbors(const HalfEdges& links, std::uint32_t a, std::uint32_t b);

/// Returns the corners of all triangles, none of which may have been removed.
std::vector<std::array<std::uint32_t, 3>> all_triangles(const HalfEdges& links);

}  // namespace meniscus
