// SPDX-License-Identifier: BSD-3-Clause
// A quick, safe answer to "is this part of a SAS sphere covered?": most atoms and circles are, and need no more work.
//
// A sphere is watched in 162 directions so dense that every point lies within a known angle of one. A direction counts
// as covered when one ball covers everything within that angle of it, with room for rounding; so "covered" is certain
// and "not covered" only means that somebody has to look closer.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "core/reduced_surface/contour/contour.h"

namespace meniscus {

/// Directions that are not surely covered, one bit each.
struct UncoveredDirections {
  std::array<std::uint64_t, 3> bits{};
  bool none() const { return (bits[0] | bits[1] | bits[2]) == 0; }
};

/// What balls surely cover of all that lies within the watched angle of a direction: dot(axis, direction) >= cosine.
struct Caps {
  std::array<std::vector<float>, 4> columns;  ///< axis, then cosine

  const float* column(std::size_t c) const { return columns[c].data(); }
  void make_room(std::size_t count);
  /// The widest ones, some six around an atom of a protein, cover most: nothing need be known of the others then.
  void widest_first(std::size_t count);
};

/// Which surroundings of the watched directions of the blockers' first ball no single blocker surely covers. caps: kept
/// from call to call for its memory; what it holds does not matter.
UncoveredDirections uncovered_directions(const Blockers& blockers, Caps& caps);

/// False if no point of the circle around `axis` (unit) at angular radius acos(`cosine`) lies near an uncovered
/// direction: then all of the circle is covered.
bool may_be_exposed(const UncoveredDirections& uncovered, const glm::dvec3& axis, double cosine);

/// Uncovered directions written out, for the many circles of one ball.
class WatchedList {
 public:
  void assign(const UncoveredDirections& uncovered);
  /// As the function of that name.
  bool may_be_exposed(const glm::dvec3& axis, double cosine) const;

 private:
  static constexpr std::size_t kMost = 176;
  std::size_t count_ = 0;  // up to whole vectors of 16
  alignas(64) std::array<float, kMost> x_{}, y_{}, z_{};
};

}  // namespace meniscus
