// SPDX-License-Identifier: BSD-3-Clause
// Numbers and sets that many threads find together are those that one thread finds alone.
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/math/union_find.h"
#include "core/surface/numbering.h"

namespace meniscus::testing {
namespace {

TEST(RowNumbers, AreTheSumsBefore) {
  for (const std::size_t rows : {0u, 1u, 511u, 512u, 513u, 5000u}) {
    const auto count = [](std::size_t n) { return static_cast<std::uint32_t>(n * 7 % 5); };
    const RowNumbers<std::uint32_t> numbers(rows, 100, count);
    std::vector<std::uint32_t> found(rows), expected(rows);
    numbers.for_each([&](std::size_t n, std::uint32_t& next) {
      found[n] = next;
      next += count(n);
    });
    std::uint32_t sum = 100;
    for (std::size_t n = 0; n < rows; ++n) {
      expected[n] = sum;
      sum += count(n);
    }
    EXPECT_EQ(found, expected) << rows << " rows";
    EXPECT_EQ(numbers.past(), sum) << rows << " rows";
  }
}

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
