// SPDX-License-Identifier: BSD-3-Clause
// A tree of points that finds exactly, for many places, whether any point is near.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

/// A balanced tree of tight boxes (J. L. Bentley, Comm. ACM 18, 509 (1975)). Unlike with a grid, the time does not grow
/// with the distance, because boxes that are entirely within or beyond it are decided at once.
class PointTree {
 public:
  /// Builds the tree in O(n log n). Points must be finite.
  explicit PointTree(std::vector<glm::dvec3> points);

  /// True if there is a point with squared distance <= reach squared, both rounded to double. It takes O(log n) for
  /// usual sets of points.
  bool any_within(const glm::dvec3& place, double reach) const;

 private:
  struct Node {
    glm::dvec3 low, high;
    std::uint32_t first, last;    ///< range in points_
    std::uint32_t far_child = 0;  ///< 0 for a leaf; the other child follows its parent in nodes_
  };
  void build(std::uint32_t first, std::uint32_t last);

  std::vector<glm::dvec3> points_;
  std::vector<Node> nodes_;
};

}  // namespace meniscus
