// SPDX-License-Identifier: BSD-3-Clause
// The periodic box of a simulation, of any shape: the shortest way between two atoms and their images.
#pragma once

#include <optional>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace meniscus {

class PeriodicCell {
 public:
  /// vectors: columns a, b, c in Å. Nothing for a box without volume, as files write it when there is none.
  /// Edges are 1e-6 to 1e9 Å long.
  static std::optional<PeriodicCell> of(const glm::dmat3& vectors);

  /// Of all d + n_a a + n_b b + n_c c with whole numbers n the shortest. Exact for every shape of box.
  glm::dvec3 shortest(glm::dvec3 d) const;

 private:
  explicit PeriodicCell(const glm::dmat3& reduced);

  glm::dmat3 vectors_, inverse_;  ///< Minkowski-reduced
  double half_shortest_squared_;  ///< what is no longer than half the shortest lattice vector has no shorter image
};

}  // namespace meniscus
