// SPDX-License-Identifier: BSD-3-Clause
// Keeps a mesh that changes from passing through itself, in the places where it is near itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/mesh/box_grid.h"
#include "core/mesh/half_edges.h"
#include "core/mesh/mesh_crossings.h"

namespace meniscus {

struct Ball;

/// Knows which vertices are watched, and the triangles at them, in a grid. Triangles that changed or are gone may still
/// be listed; they are looked at as they are now.
class CrossingGuard {
 public:
  /// Watches nothing. links, positions: of the mesh that it guards; they have to live as long.
  CrossingGuard(const HalfEdges& links, const std::vector<glm::dvec3>& positions)
      : links_(links), positions_(positions), watched_(links.vertex_count(), 0) {}

  /// Watches the vertices in these balls from now on.
  void watch(std::span<const Ball> places) { mark(places, kLasting); }
  /// Watches what is around these triangles until release().
  void watch_around(std::span<const std::uint32_t> triangles);
  void release();
  bool watches(std::uint32_t vertex) const { return watched_[vertex] != 0; }

  /// A vertex that came between these two is watched if one of them is.
  void add_vertex(std::uint32_t a, std::uint32_t b) { watched_.push_back(watched_[a] | watched_[b]); }
  /// So is a vertex that another goes into.
  void merge_vertex(std::uint32_t a, std::uint32_t into) { watched_[into] |= watched_[a]; }
  /// Lists a triangle that is new or has moved.
  void add(std::uint32_t triangle);
  /// After HalfEdges::compact(), which returned this.
  void compact(std::span<const std::uint32_t> old_vertices);

  /// How many pairs of the new triangles, which are neighbours, pass through one another, or of one of them and one
  /// that is listed and stays? `gone` are those that they replace. Not for several threads at once.
  std::size_t crossings(std::span<const PlacedTriangle> made, std::span<const std::uint32_t> gone) const;
  PlacedTriangle placed(std::uint32_t triangle) const;

 private:
  /// How a vertex is watched: bits.
  static constexpr std::uint8_t kLasting = 1, kForNow = 2;
  void mark(std::span<const Ball> places, std::uint8_t how);
  void list();
  void list_near(std::span<const PlacedTriangle> made, std::span<const std::uint32_t> gone) const;

  const HalfEdges& links_;
  const std::vector<glm::dvec3>& positions_;
  std::vector<std::uint8_t> watched_;  ///< per vertex
  BoxGrid grid_;
  // of the last question: not to be asked by two threads
  mutable std::vector<PlacedTriangle> near_;
  mutable std::vector<std::uint32_t> seen_;  ///< per triangle: the number of the question that last met it
  mutable std::uint32_t question_ = 0;
};

}  // namespace meniscus
