// SPDX-License-Identifier: BSD-3-Clause
// Builds and searches the tree. Decisions about boxes agree with those about points, because rounding keeps the order
// of numbers: a distance to the near (far) side of a box, summed in the same order, never exceeds (falls below) that of
// a point inside.
#include "core/structure/point_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/common.hpp>

namespace meniscus {
namespace {

constexpr std::uint32_t kLeafPoints = 8;

double squared_length(const glm::dvec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

}  // namespace

PointTree::PointTree(std::vector<glm::dvec3> points) : points_(std::move(points)) {
  if (!points_.empty()) build(0, static_cast<std::uint32_t>(points_.size()));
}

void PointTree::build(std::uint32_t first, std::uint32_t last) {
  const std::size_t own = nodes_.size();
  Node node{points_[first], points_[first], first, last};
  for (std::uint32_t n = first; n < last; ++n) {
    node.low = glm::min(node.low, points_[n]);
    node.high = glm::max(node.high, points_[n]);
  }
  nodes_.push_back(node);
  if (last - first <= kLeafPoints) return;
  const glm::dvec3 extent = node.high - node.low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(points_.begin() + first, points_.begin() + middle, points_.begin() + last,
                   [axis](const glm::dvec3& a, const glm::dvec3& b) { return a[axis] < b[axis]; });
  build(first, middle);
  nodes_[own].far_child = static_cast<std::uint32_t>(nodes_.size());
  build(middle, last);
}

bool PointTree::any_within(const glm::dvec3& place, double reach) const {
  const double limit = reach * reach;
  std::array<std::uint32_t, 64> pending{};  // 2^32 points have 32 levels
  std::size_t count = 0;
  if (!nodes_.empty()) pending[count++] = 0;
  while (count > 0) {
    const std::uint32_t own = pending[--count];
    const Node& node = nodes_[own];
    const glm::dvec3 below = node.low - place, above = place - node.high;
    if (squared_length(glm::max(glm::max(below, above), glm::dvec3(0.0))) > limit) continue;
    if (squared_length(glm::max(glm::abs(below), glm::abs(above))) <= limit) return true;
    if (node.far_child != 0) {
      pending[count++] = node.far_child;
      pending[count++] = own + 1;
      continue;
    }
    for (std::uint32_t n = node.first; n < node.last; ++n) {
      if (squared_length(points_[n] - place) <= limit) return true;
    }
  }
  return false;
}

}  // namespace meniscus
