// SPDX-License-Identifier: BSD-3-Clause
// The positions of a small probe inside a hull: cells of a lattice that miss none of them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/math/box.h"
#include "core/pockets/hull.h"

namespace meniscus {

/// Cubes that together hold every place where a probe touches no ball and is at least so far from the large probe's
/// centre. Found by halving larger cubes down to half an Ångström, unless all of one is such a place: both distances
/// change by no more than a step's length.
class ProbeCells {
 public:
  /// atoms: the hull's; probe_radius: of the small probe, Å; clearance: Å, of its centre from Hull::to_probe. Runs on
  /// all cores TBB may use; the cells do not depend on their number.
  ProbeCells(std::span<const Ball> atoms, double probe_radius, const Hull& hull, double clearance);

  std::size_t count() const { return boxes_.size(); }
  /// The box around all cells, wider by `reach` on each side. There must be a cell.
  Box bounds(double reach) const;
  /// Whether some cell is no farther than this; with 0, whether one holds the point.
  bool within(const glm::dvec3& point, double reach) const;

 private:
  std::vector<Box> boxes_;
  BoxTree tree_;
};

}  // namespace meniscus
