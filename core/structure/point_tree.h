// SPDX-License-Identifier: BSD-3-Clause
// Tells exactly, for many places, whether any of a set of points is within reach.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

/// A balanced tree of tight boxes (J. L. Bentley, Comm. ACM 18, 509 (1975)). Unlike in a grid, time does not grow with
/// the reach: boxes wholly inside or outside it are decided at once.
class PointTree {
 public:
  /// O(n log n). Points are finite.
  explicit PointTree(std::vector<glm::dvec3> points);

  /// Is there a point with squared distance <= reach squared, both rounded to double? O(log n) for usual point sets.
  bool any_within(const glm::dvec3& place, double reach) const;

 private:
  struct Node {
    glm::dvec3 low, high;
    std::uint32_t first, last;    ///< points_
    std::uint32_t far_child = 0;  ///< the other child follows its parent; 0: a leaf
  };
  void build(std::uint32_t first, std::uint32_t last);

  std::vector<glm::dvec3> points_;
  std::vector<Node> nodes_;
};

}  // namespace meniscus
