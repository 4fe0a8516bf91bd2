// SPDX-License-Identifier: BSD-3-Clause
// Tests all balls against one circle at once, where they leave nothing of it or a single arc: nearly all
// circles.
#pragma once

#include <cstddef>

#include "core/math/geometry.h"
#include "core/reduced_surface/contour/blockers.h"

namespace meniscus {

/// What is left of one circle as a union of covered arcs, seen from the end of the widest of them. Reused from circle
/// to circle to save allocations.
class CircleSweep {
 public:
  enum class Outcome {
    unknown,  ///< rounding leaves doubt, or there are several arcs
    whole,    ///< nothing covers any of it
    covered,
    one_arc
  };

  /// meetings: of these blockers and the circle.
  Outcome find(const CircleMeetings& meetings, const Blockers& blockers);

  /// What is left after Outcome::one_arc, between the same pseudo-angles as by one ball after the other.
  const geometry::ExposedArc& arc() const { return arc_; }

 private:
  Outcome close_in(const CircleMeetings& meetings, const Blockers& blockers, double low, double high, double blur);

  enum Column : std::size_t { kBegin, kEnd, kColumnCount };
  ColumnTable<kColumnCount> from_;  // of covered arcs, per blocker: pseudo-angles from where the widest one ends
  geometry::ExposedArc arc_{};
};

}  // namespace meniscus
