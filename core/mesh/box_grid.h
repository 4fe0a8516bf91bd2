// SPDX-License-Identifier: BSD-3-Clause
// Boxes in cells of space, which are hashed: those that may meet a box are found without a search.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "core/base/index.h"
#include "core/math/box_tree.h"

namespace meniscus {

/// Have two boxes no point in common?
inline bool are_apart(const Box& a, const Box& b) {
  return a.low.x > b.high.x || b.low.x > a.high.x || a.low.y > b.high.y || b.low.y > a.high.y || a.low.z > b.high.z ||
         b.low.z > a.high.z;
}
inline double longest_side(const Box& box) {
  const glm::dvec3 size = box.high - box.low;
  return std::max({size.x, size.y, size.z});
}

/// A grid without bounds (Teschner, Heidelberger, Mueller, Pomeranets & Gross, "Optimized spatial hashing", 2003): each
/// bucket has the boxes of some cells.
class BoxGrid {
 public:
  /// cell: Å, the side of a cell; count: about how many boxes will be added.
  explicit BoxGrid(double cell = 1.0, std::size_t count = 0)
      : cell_(cell), heads_(std::bit_ceil(std::max(2 * count, kFewestBuckets)), kNone) {}

  void add(std::uint32_t number, const Box& box) {
    for_each_bucket(box, [&](std::size_t bucket) {
      std::uint32_t& head = heads_[bucket];
      if (head != kNone && entries_[head].number == number) return;  // of another cell
      entries_.push_back({number, head});
      head = static_cast<std::uint32_t>(entries_.size() - 1);
    });
  }

  /// visit(number) for all boxes that may meet this one, some of them several times.
  template <typename Visit>
  void for_each_near(const Box& box, const Visit& visit) const {
    for_each_bucket(box, [&](std::size_t bucket) { for_each_in(bucket, visit); });
  }

  std::size_t bucket_count() const { return heads_.size(); }
  std::size_t bucket_of(const glm::dvec3& x) const { return bucket_of_cell(cell_of(x)); }
  template <typename Visit>
  void for_each_in(std::size_t bucket, const Visit& visit) const {
    for (std::uint32_t e = heads_[bucket]; e != kNone; e = entries_[e].next) visit(entries_[e].number);
  }

 private:
  static constexpr std::size_t kFewestBuckets = 64;
  struct Entry {
    std::uint32_t number, next;
  };

  glm::i64vec3 cell_of(const glm::dvec3& x) const { return glm::i64vec3(glm::floor(x / cell_)); }
  std::size_t bucket_of_cell(const glm::i64vec3& cell) const {
    const auto hash = static_cast<std::size_t>((cell.x * 73856093) ^ (cell.y * 19349663) ^ (cell.z * 83492791));
    return hash & (heads_.size() - 1);
  }
  template <typename Visit>
  void for_each_bucket(const Box& box, const Visit& visit) const {
    const glm::i64vec3 low = cell_of(box.low), high = cell_of(box.high);
    glm::i64vec3 at = low;
    for (at.x = low.x; at.x <= high.x; ++at.x)
      for (at.y = low.y; at.y <= high.y; ++at.y)
        for (at.z = low.z; at.z <= high.z; ++at.z) visit(bucket_of_cell(at));
  }

  double cell_;
  std::vector<std::uint32_t> heads_;  ///< per bucket, into entries_, or kNone
  std::vector<Entry> entries_;
};

}  // namespace meniscus
