// SPDX-License-Identifier: BSD-3-Clause
// Prefix sums over words that kernels wrote and kernels read.
#pragma once

#include <cstdint>
#include <optional>

#include "core/gpu/buffer.h"
#include "core/gpu/program.h"

namespace meniscus {

/// How invocations share a sum; the result is the same.
enum class ScanKind {
  serial,   ///< kernel "parallel/scan": each adds up a chunk by itself, as suits software GL
  parallel  ///< kernel "parallel/block_scan": groups add up together, as suits a GPU
};

/// Both kernels and their scratch memory. Needs a current GL context.
class PrefixSum {
 public:
  /// kind: that which suits the device, if not told.
  explicit PrefixSum(ProgramCache& programs, std::optional<ScanKind> kind = {}) : programs_(programs), kind_(kind) {}

  /// Replaces each of the first `count` words by the sum of those before it; words[count] becomes the sum of all.
  /// `words` holds count + 1 words. No sum gets larger than `limit`: places in a list that has no more room.
  void operator()(const Buffer& words, std::uint32_t count, std::uint32_t limit = ~0u);

 private:
  ProgramCache& programs_;
  std::optional<ScanKind> kind_;
  Buffer totals_;
};

}  // namespace meniscus
