// SPDX-License-Identifier: BSD-3-Clause
// Tests all balls against one circle at once, for the common case that they leave nothing of it or a single arc.
#pragma once

#include <cstddef>

#include "core/math/double_geometry.h"
#include "core/reduced_surface/contour/blockers.h"

namespace meniscus {

/// The remainder of one circle under a union of covered arcs, seen from the end of the widest arc. Reused from circle
/// to circle to save allocations.
class CircleSweep {
 public:
  enum class Outcome {
    unknown,  ///< rounding leaves doubt, or there are several arcs
    whole,    ///< no ball covers any part of it
    covered,
    one_arc
  };

  /// Finds the remainder. meetings: the meetings of these blockers with the circle.
  Outcome find(const CircleMeetings& meetings, const Blockers& blockers);

  /// Returns the remaining arc after Outcome::one_arc, between the same pseudo-angles as by one ball after another.
  const geometry::ExposedArc& arc() const { return arc_; }

 private:
  Outcome close_in(const CircleMeetings& meetings, const Blockers& blockers, double low, double high, double blur);

  enum Column : std::size_t { kBegin, kEnd, kColumnCount };
  ColumnTable<kColumnCount> from_;  // per blocker: pseudo-angles of its covered arc from the end of the widest one
  geometry::ExposedArc arc_{};
};

}  // namespace meniscus
