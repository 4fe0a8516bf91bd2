// SPDX-License-Identifier: BSD-3-Clause
// Counts ties: circles whose exposed arcs depend on the growth of the decision weights.
#pragma once

#include <cstdint>

#include "core/reduced_surface/contour/contour.h"
#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {

/// Decides circles once more, for radii shrunk by as much as decisions grow them. A sign that is the same for both is
/// the same for the radii as given: within 1e-9 Å all that decides is as good as linear. Reused from circle to circle.
class TieWatch {
 public:
  /// What expose() left of a circle in doubt. blockers, skip: as then; first: index of the atom whose blockers these
  /// are; index_of(label): the index of another.
  template <typename IndexOf>
  void look(const Contour& decided, const Blockers& blockers, std::size_t skip, std::uint32_t first,
            const IndexOf& index_of) {
    shrunk_.restart(shrunk_weight(blockers.first_weight(), first));
    for (std::size_t n = 0; n < blockers.size(); ++n) {
      const Blockers::Ball ball = blockers[n];
      shrunk_.add(ball.center, shrunk_weight(ball.weight, index_of(ball.label)), ball.label);
    }
    contour_.expose(shrunk_[skip].center, shrunk_[skip].weight, shrunk_, skip);
    if (!leave_the_same(decided, contour_)) ++ties_;
  }

  std::size_t ties() const { return ties_; }

 private:
  static bool leave_the_same(const Contour& a, const Contour& b) {
    const auto same = [](const ExposedArc& x, const ExposedArc& y) {
      return x.begin_by == y.begin_by && x.end_by == y.end_by;
    };
    return a.whole() == b.whole() && std::ranges::equal(a.arcs(), b.arcs(), same);
  }

  Blockers shrunk_;
  Contour contour_;
  std::size_t ties_ = 0;
};

}  // namespace meniscus
