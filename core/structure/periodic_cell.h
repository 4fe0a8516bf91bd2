// SPDX-License-Identifier: BSD-3-Clause
// The periodic box of a simulation, of any shape, and the shortest vector between two atoms or their images.
#pragma once

#include <optional>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace meniscus {

/// A periodic box.
class PeriodicCell {
 public:
  /// Makes the box of vectors a, b, c in the columns, in Å. Returns nothing for a box without volume, which files have
  /// where there is no box, and for edges that are not 1e-6 to 1e9 Å long.
  static std::optional<PeriodicCell> of(const glm::dmat3& vectors);

  /// Returns the shortest of all vectors d + n_a a + n_b b + n_c c with integers n. It is exact for every shape of box.
  glm::dvec3 shortest(glm::dvec3 d) const;

 private:
  explicit PeriodicCell(const glm::dmat3& reduced);

  glm::dmat3 vectors_, inverse_;  ///< Minkowski-reduced, and the inverse
  /// Square of half the shortest lattice vector; a vector of this length has no shorter image.
  double half_shortest_squared_;
};

}  // namespace meniscus
