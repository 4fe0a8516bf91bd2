// SPDX-License-Identifier: BSD-3-Clause
// The places of a small probe inside a hull, as cells of a lattice that miss none of them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/math/box.h"
#include "core/pockets/hull.h"

namespace meniscus {

/// Cubes that together hold every place where a probe touches no ball and is at least `clearance` from the large
/// probe's centre. Larger cubes are halved down to half an Ångström, unless all of a cube is such a place. This works
/// because both distances change by no more than the length of a step.
class ProbeCells {
 public:
  /// `atoms` are those of the hull, `probe_radius` is that of the small probe (Å), and `clearance` (Å) is the smallest
  /// Hull::to_probe() of its centre. Runs on all cores that TBB may use; the cells do not depend on their number.
  ProbeCells(std::span<const Ball> atoms, double probe_radius, const Hull& hull, double clearance);

  std::size_t count() const { return boxes_.size(); }
  /// Returns the box around all cells, extended by `reach` (Å) on each side. There must be a cell.
  Box bounds(double reach) const;
  /// True if some cell is no farther than `reach` (Å) from the point; with 0, if one holds the point.
  bool within(const glm::dvec3& point, double reach) const;

 private:
  std::vector<Box> boxes_;
  BoxTree tree_;
};

}  // namespace meniscus
