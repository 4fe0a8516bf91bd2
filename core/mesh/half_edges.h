// SPDX-License-Identifier: BSD-3-Clause
// Triangle meshes whose edges can be split, collapsed and flipped without a change of topology.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/constants.h"

namespace meniscus {

/// Per vertex the corners (3 * triangle + 0..2) there, ascending. The triangles need not be a closed mesh, nor a
/// manifold.
class CornerLists {
 public:
  CornerLists(std::span<const std::array<std::uint32_t, 3>> triangles, std::uint32_t vertex_count);

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(first_.size() - 1); }
  std::span<const std::uint32_t> at(std::uint32_t vertex) const {
    return {corners_.data() + first_[vertex], first_[vertex + 1] - first_[vertex]};
  }

 private:
  std::vector<std::uint32_t> first_;  ///< per vertex, and one more: into corners_
  std::vector<std::uint32_t> corners_;
};

/// Do the triangles at these corners of one vertex go around it once? Not if they are fewer than three.
bool go_around_once(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const std::uint32_t> corners);

/// Half-edge 3 t + k of triangle t goes from its corner k to corner (k + 1) % 3. Triangles and vertices that were taken
/// away keep their numbers until compact().
class HalfEdges {
 public:
  /// triangles: closed; each edge has two, which walk it in opposite directions. Throws OpenSurfaceError otherwise.
  HalfEdges(std::span<const std::array<std::uint32_t, 3>> triangles, std::uint32_t vertex_count);
  /// Of some triangles of a mesh; corners: of these. A half-edge without exactly one that goes back has no twin
  /// (kNone). Only around vertices whose triangles go_around_once() may anything be asked or changed.
  static HalfEdges of_part(std::span<const std::array<std::uint32_t, 3>> triangles, const CornerLists& corners);

  static std::uint32_t next(std::uint32_t half) { return half % 3 == 2 ? half - 2 : half + 1; }
  static std::uint32_t last(std::uint32_t half) { return half % 3 == 0 ? half + 2 : half - 1; }
  std::uint32_t half_edge_count() const { return static_cast<std::uint32_t>(from_.size()); }
  std::uint32_t triangle_count() const { return half_edge_count() / 3; }
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(leaving_.size()); }
  bool lives(std::uint32_t half) const { return from_[half] != kNone; }
  bool vertex_lives(std::uint32_t vertex) const { return leaving_[vertex] != kNone; }
  std::uint32_t from(std::uint32_t half) const { return from_[half]; }
  std::uint32_t to(std::uint32_t half) const { return from_[next(half)]; }
  std::uint32_t opposite(std::uint32_t half) const { return from_[last(half)]; }
  std::uint32_t twin(std::uint32_t half) const { return twin_[half]; }
  /// Some half-edge that leaves a vertex, or kNone.
  std::uint32_t leaving(std::uint32_t vertex) const { return leaving_[vertex]; }
  std::array<std::uint32_t, 3> corners(std::uint32_t triangle) const {
    return {from_[3 * triangle], from_[3 * triangle + 1], from_[3 * triangle + 2]};
  }
  /// A border of the surface that the edge runs along, or kNone; the same for both half-edges.
  std::uint32_t crease(std::uint32_t half) const { return crease_[half]; }
  void set_crease(std::uint32_t half, std::uint32_t border) { crease_[half] = crease_[twin_[half]] = border; }

  /// Calls visit(half-edge that leaves) for those around a vertex, clockwise.
  template <typename Visit>
  void around(std::uint32_t vertex, const Visit& visit) const {
    const std::uint32_t first = leaving_[vertex];
    std::uint32_t half = first;
    do {
      visit(half);
      half = next(twin_[half]);
    } while (half != first);
  }
  /// Is that so of each half-edge that leaves a vertex? Asked is no further than to the first of which it is not.
  template <typename Predicate>
  bool all_around(std::uint32_t vertex, const Predicate& is_so) const {
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
    around(vertex, [&](std::uint32_t) { ++count; });
    return count;
  }
  /// Some half-edge from one vertex to another, or kNone.
  std::uint32_t between(std::uint32_t from, std::uint32_t to) const;

  /// Puts a new vertex on an edge, and returns it. Both halves keep the crease.
  std::uint32_t split(std::uint32_t half);
  /// Puts a new vertex into a triangle, and returns it.
  std::uint32_t poke(std::uint32_t triangle);
  /// The inverse of poke(): takes out the vertex opposite to a half-edge, which has three edges. Of its triangles that
  /// of the half-edge stays, and covers all three.
  void unpoke(std::uint32_t half);
  /// Would the surface stay a closed one of the same topology without this edge?
  bool can_collapse(std::uint32_t half) const;
  /// Moves the edge's first vertex into its second: it and two triangles are gone.
  void collapse(std::uint32_t half);
  /// Would the other diagonal be a new edge?
  bool can_flip(std::uint32_t half) const;
  /// Puts the other diagonal of the two triangles in its place.
  void flip(std::uint32_t half);
  /// Renumbers the half-edges of a triangle in a circle, so that this one is its first.
  void put_first(std::uint32_t half);

  /// Renumbers what lives in order; returns the old number of each vertex.
  std::vector<std::uint32_t> compact();

 private:
  enum class Open : std::uint8_t { refused, allowed };
  HalfEdges(std::span<const std::array<std::uint32_t, 3>> triangles, const CornerLists& corners, Open open);
  void link(std::uint32_t a, std::uint32_t b, std::uint32_t crease) {
    twin_[a] = b;
    twin_[b] = a;
    crease_[a] = crease_[b] = crease;
  }

  std::vector<std::uint32_t> from_;     // per half-edge; kNone: its triangle is gone
  std::vector<std::uint32_t> twin_;     // per half-edge
  std::vector<std::uint32_t> crease_;   // per half-edge
  std::vector<std::uint32_t> leaving_;  // per vertex: one half-edge; kNone: gone
};

/// What two vertices have around them.
struct CommonNeighbors {
  std::uint32_t common = 0;  ///< neighbours of both
  std::uint32_t sum = 0;     ///< neighbours of the one and of the other, added up
};
CommonNeighbors common_neighbors(const HalfEdges& links, std::uint32_t a, std::uint32_t b);

/// The corners of all triangles, none of which may be gone.
std::vector<std::array<std::uint32_t, 3>> all_triangles(const HalfEdges& links);

}  // namespace meniscus
