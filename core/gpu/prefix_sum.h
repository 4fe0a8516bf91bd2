// SPDX-License-Identifier: BSD-3-Clause
// Prefix sums over words that kernels wrote and kernels read.
#pragma once

#include <cstdint>

#include "core/gpu/buffer.h"
#include "core/gpu/program.h"

namespace meniscus {

/// Kernel "parallel/scan" and its scratch memory. Needs a current GL context.
class PrefixSum {
 public:
  explicit PrefixSum(ProgramCache& programs) : programs_(programs) {}

  /// Replaces each of the first `count` words by the sum of those before it; words[count] becomes the sum of all.
  /// `words` holds count + 1 words. No sum gets larger than `limit`: places in a list that has no more room.
  void operator()(const Buffer& words, std::uint32_t count, std::uint32_t limit = ~0u);

 private:
  ProgramCache& programs_;
  Buffer totals_;
};

}  // namespace meniscus
