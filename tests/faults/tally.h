// SPDX-License-Identifier: BSD-3-Clause
// The data that the preloaded library (failing_calls.cpp) passes to the test, in a file that both map into memory.
#pragma once

#include <array>
#include <cstdint>

namespace meniscus::test {

struct Tally {
  std::uint64_t calls = 0;                     ///< calls of the requested kind
  std::uint64_t failed = 0;                    ///< 1 if one was made to fail
  std::uint64_t places = 0;                    ///< number of call stacks that allocations came from, if none fails
  std::array<std::uint64_t, 1 << 16> first{};  ///< number of the first allocation from each stack
};

}  // namespace meniscus::test
