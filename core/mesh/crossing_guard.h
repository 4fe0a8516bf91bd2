// SPDX-License-Identifier: BSD-3-Clause
// Keeps a mesh that changes from passing through itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/mesh/half_edges.h"
#include "core/mesh/mesh_crossings.h"

namespace meniscus {

/// Knows the triangles of a mesh in the places where it is near itself, in a grid whose cells are hashed. Triangles
/// that changed or are gone may still be listed; they are looked at as they are now.
class CrossingGuard {
 public:
  /// links, positions: of the mesh that it guards; they have to live as long.
  CrossingGuard(const HalfEdges& links, const std::vector<glm::dvec3>& positions)
      : links_(links), positions_(positions) {}

  /// Forgets all, and lists the triangles that have a vertex of `watched`.
  void list(const std::vector<std::uint8_t>& watched);
  /// Lists one more, or one that has moved.
  void add(std::uint32_t triangle);
  /// How many pairs of the new triangles, which are neighbours, pass through one another, or of one of them and one
  /// that is listed and stays? `gone` are those that they replace. Not for several threads at once.
  std::size_t crossings(std::span<const PlacedTriangle> made, std::span<const std::uint32_t> gone) const;
  PlacedTriangle placed(std::uint32_t triangle) const;

 private:
  struct Entry {
    std::uint32_t triangle, next;
  };

  template <typename Visit>
  void each_cell(const glm::dvec3& low, const glm::dvec3& high, const Visit& visit) const;
  void list_near(std::span<const PlacedTriangle> made, std::span<const std::uint32_t> gone) const;

  const HalfEdges& links_;
  const std::vector<glm::dvec3>& positions_;
  double cell_ = 1.0;                 ///< Å
  std::vector<std::uint32_t> heads_;  ///< per bucket, into entries_, or kNone
  std::vector<Entry> entries_;
  // of the last question: not to be asked by two threads
  mutable std::vector<PlacedTriangle> near_;
  mutable std::vector<std::uint32_t> seen_;  ///< per triangle: the number of the question that last met it
  mutable std::uint32_t question_ = 0;
};

}  // namespace meniscus
