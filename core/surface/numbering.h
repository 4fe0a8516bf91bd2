// SPDX-License-Identifier: BSD-3-Clause
// Numbers for rows of varying length on all cores: counted chunk by chunk, then filled in from the sums before.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>

namespace meniscus {

/// Counts, for each row of a table, whatever is numbered in the order of the rows. A `Sum` is a number, or a struct
/// with
/// +=, zero when made. The numbers do not depend on the threads that count.
template <typename Sum>
class RowNumbers {
 public:
  /// `count(n)` says how many row n has, for n from 0 to `rows` - 1. The first row's begin at `first`.
  template <typename Count>
  RowNumbers(std::size_t rows, const Sum& first, const Count& count) : rows_(rows), before_(chunks() + 1, Sum{}) {
    tbb::parallel_for(std::size_t{0}, chunks(), [&](std::size_t chunk) {
      Sum sum{};
      for_each_row(chunk, [&](std::size_t n) { sum += count(n); });
      before_[chunk + 1] = sum;
    });
    before_[0] = first;
    for (std::size_t chunk = 0; chunk < chunks(); ++chunk) {
      Sum sum = before_[chunk];
      sum += before_[chunk + 1];
      before_[chunk + 1] = sum;
    }
  }

  /// What comes behind the last row.
  const Sum& past() const { return before_.back(); }

  /// Calls `fill(n, next)` once for each row, in rising order within a chunk: `next` is the number of its first item,
  /// and fill leaves it at that of the row behind.
  template <typename Fill>
  void for_each(const Fill& fill) const {
    tbb::parallel_for(std::size_t{0}, chunks(), [&](std::size_t chunk) {
      Sum next = before_[chunk];
      for_each_row(chunk, [&](std::size_t n) { fill(n, next); });
    });
  }

 private:
  static constexpr std::size_t kChunk = 512;

  std::size_t chunks() const { return (rows_ + kChunk - 1) / kChunk; }

  template <typename Visit>
  void for_each_row(std::size_t chunk, const Visit& visit) const {
    for (std::size_t n = chunk * kChunk, past = std::min(rows_, n + kChunk); n < past; ++n) visit(n);
  }

  std::size_t rows_;
  std::vector<Sum> before_;  // of each chunk
};

}  // namespace meniscus
