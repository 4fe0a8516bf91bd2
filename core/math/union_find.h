// SPDX-License-Identifier: BSD-3-Clause
// Disjoint sets of indices. The representative of a set is its smallest index.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace meniscus {

/// Disjoint sets of the indices from 0 to count - 1. At first each index is a set of its own.
class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  /// Returns the representative of the set that contains n.
  std::uint32_t find(std::uint32_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }

  /// Unites the sets that contain a and b.
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    if (b < a) std::swap(a, b);
    parent_[b] = a;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// A UnionFind whose sets several threads may unite at the same time. The sets do not depend on the order of the calls
/// (R. J. Anderson and H. Woll 1991). A representative is final once all threads have united their sets.
class SharedUnionFind {
 public:
  explicit SharedUnionFind(std::size_t count)
      : parent_(std::make_unique_for_overwrite<std::atomic<std::uint32_t>[]>(count)) {
    for (std::size_t n = 0; n < count; ++n) parent_[n].store(static_cast<std::uint32_t>(n), std::memory_order_relaxed);
  }

  std::uint32_t find(std::uint32_t n) {
    for (;;) {
      std::uint32_t parent = parent_[n].load(std::memory_order_relaxed);
      if (parent == n) return n;
      const std::uint32_t above = parent_[parent].load(std::memory_order_relaxed);
      // Parents only become smaller, so that a path stays a path when another thread shortens it at the same time.
      if (above != parent) parent_[n].compare_exchange_weak(parent, above, std::memory_order_relaxed);
      n = above;
    }
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    for (;;) {
      a = find(a);
      b = find(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      std::uint32_t root = a;
      if (parent_[a].compare_exchange_strong(root, b, std::memory_order_relaxed)) return;
    }
  }

 private:
  std::unique_ptr<std::atomic<std::uint32_t>[]> parent_;
};

}  // namespace meniscus
