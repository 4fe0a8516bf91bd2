// SPDX-License-Identifier: BSD-3-Clause
// Sets that many threads join are those that one thread joins alone.
#include "core/math/union_find.h"

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace meniscus::testing {
namespace {

TEST(SharedUnionFind, JoinsWhatOneThreadJoins) {
  constexpr std::uint32_t kCount = 20000;
  std::mt19937 random(3);
  for (const std::size_t pair_count : {100u, 10000u, 40000u}) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::size_t n = 0; n < pair_count; ++n) pairs.emplace_back(random() % kCount, random() % kCount);
    UnionFind alone(kCount);
    for (const auto& [a, b] : pairs) alone.unite(a, b);
    SharedUnionFind shared(kCount);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pairs.size(), 16), [&](const auto& range) {
      for (std::size_t n = range.begin(); n != range.end(); ++n) shared.unite(pairs[n].first, pairs[n].second);
    });
    for (std::uint32_t n = 0; n < kCount; ++n) ASSERT_EQ(shared.find(n), alone.find(n)) << pair_count << " pairs";
  }
}

}  // namespace
}  // namespace meniscus::testing
