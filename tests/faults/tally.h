// SPDX-License-Identifier: BSD-3-Clause
// The data that the preloaded library (failing_calls.cpp) passes to the test, in a file that both map into memory.
#pragma once

#include <array>
#include <cstdint>

namespace meniscus::test {

struct Tally {
  std::uint64_t calls = 0;   ///< of the kind that was asked for
  std::uint64_t failed = 0;  ///< 1 if one was made to fail
  std::uint64_t places = 0;  ///< allocations, when none fails: from how many different stacks of callers they come
  std::array<std::uint64_t, 1 << 16> first{};  ///< and the number of the first from each
};

}  // namespace meniscus::test
