// SPDX-License-Identifier: BSD-3-Clause
// Axis-aligned boxes, and a tree of boxes that is searched from the nearest to the farthest.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace meniscus {

/// An axis-aligned box that includes both corners, in Å. It is empty at first.
struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  void include(const glm::dvec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  /// Returns the squared distance (Å²) from a point to the box. It is 0 inside.
  double squared_distance(const glm::dvec3& x) const {
    const glm::dvec3 outside = glm::max(glm::max(low - x, x - high), glm::dvec3(0.0));
    return glm::dot(outside, outside);
  }
};

/// A tree of boxes around objects, which are visited roughly in the order of their distance from a point.
class BoxTree {
 public:
  explicit BoxTree(std::span<const Box> boxes) : order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (boxes.empty()) return;
    nodes_.reserve(2 * boxes.size() / kLeaf + 1);
    build(boxes, 0, static_cast<std::uint32_t>(boxes.size()));
  }

  /// Calls visit(index, limit) for the objects whose boxes are nearer to x than `limit` (Å). The call looks at the
  /// object and returns the limit for all further objects: the old one, or less.
  template <typename Visit>
  void nearest(const glm::dvec3& x, double limit, Visit&& visit) const {
    if (nodes_.empty()) return;
    struct Waiting {
      std::uint32_t node;
      double squared;
    };
    std::array<Waiting, kDeepest> stack;
    std::size_t waiting = 0;
    stack[waiting++] = {0, nodes_[0].box.squared_distance(x)};
    while (waiting > 0) {
      const Waiting next = stack[--waiting];
      if (next.squared >= limit * limit) continue;
      const Node& node = nodes_[next.node];
      if (node.second_child == 0) {
        for (std::uint32_t n = node.first; n < node.last; ++n) limit = visit(order_[n], limit);
        continue;
      }
      Waiting near{next.node + 1, nodes_[next.node + 1].box.squared_distance(x)};
      Waiting far{node.second_child, nodes_[node.second_child].box.squared_distance(x)};
      if (far.squared < near.squared) std::swap(near, far);
      stack[waiting++] = far;
      stack[waiting++] = near;
    }
  }

 private:
  static constexpr std::uint32_t kLeaf = 4;  // greatest number of boxes in a leaf
  static constexpr std::size_t kDeepest =
      128;  // greatest depth: 2^32 boxes halved, with one waiting node on each level

  struct Node {
    Box box;
    std::uint32_t first = 0, last = 0;  // range in order_
    std::uint32_t second_child = 0;     // 0 for a leaf; the first child follows its parent in nodes_
  };

  void build(std::span<const Box> boxes, std::uint32_t first, std::uint32_t last) {
    const auto self = static_cast<std::uint32_t>(nodes_.size());
    Box all = boxes[order_[first]];
    for (std::uint32_t n = first; n < last; ++n) {
      all.low = glm::min(all.low, boxes[order_[n]].low);
      all.high = glm::max(all.high, boxes[order_[n]].high);
    }
    nodes_.push_back({all, first, last, 0});
    if (last - first <= kLeaf) return;
    const glm::dvec3 size = all.high - all.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last, [&](auto a, auto b) {
      return boxes[a].low[axis] + boxes[a].high[axis] < boxes[b].low[axis] + boxes[b].high[axis];
    });
    build(boxes, first, middle);
    nodes_[self].second_child = static_cast<std::uint32_t>(nodes_.size());
    build(boxes, middle, last);
  }

  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace meniscus
