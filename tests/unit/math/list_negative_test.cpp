// SPDX-License-Identifier: BSD-3-Clause
// Listing negative numbers eight at a time gives the list of a plain loop.
#include "core/math/vector_loops.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace meniscus {
namespace {

// Lists have any length, and anything behind their ends.
template <typename Number>
void expect_plain_lists() {
  constexpr std::uint32_t kFirst = 70;
  std::mt19937_64 random(5);
  for (std::size_t count = 0; count <= 40; ++count)
    for (int round = 0; round < 200; ++round) {
      std::vector<Number> numbers(48, Number{-1});
      for (std::size_t n = 0; n < count; ++n) numbers[n] = static_cast<Number>(random());
      std::vector<std::uint32_t> expected, listed(48, 0);
      for (std::uint32_t n = 0; n < count; ++n)
        if (numbers[n] < 0) expected.push_back(kFirst + n);
      const std::uint32_t* past = list_negative(numbers.data(), count, kFirst, listed.data());
      listed.resize(static_cast<std::size_t>(past - listed.data()));
      ASSERT_EQ(listed, expected) << count;
    }
}

TEST(ListNegative, ListsWhatAPlainLoopLists) {
  expect_plain_lists<std::int16_t>();
  expect_plain_lists<std::int64_t>();
}

}  // namespace
}  // namespace meniscus
