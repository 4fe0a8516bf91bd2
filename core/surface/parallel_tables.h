// SPDX-License-Identifier: BSD-3-Clause
// Large tables built on all cores: their memory, and the numbering of rows of varying length.
#pragma once

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tbb/parallel_for.h>

namespace meniscus {

/// Requests new memory for [begin, begin + bytes) at once, chunk by chunk on all threads. Memory that comes page by
/// page, when it is first written, takes more time on a single thread. Nothing changes where the memory is already
/// there, or where the system (before Linux 5.14) does not know the request.
inline void populate(void* begin, std::size_t bytes) {
#ifdef MADV_POPULATE_WRITE
  constexpr std::size_t kPage = 4096, kChunk = 1 << 20, kWorthIt = 32 << 20;
  if (bytes < kWorthIt) return;
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::size_t first = (address + kPage - 1) / kPage * kPage - address;  // the first whole page, from `begin`
  const std::size_t past = (address + bytes) / kPage * kPage - address;
  tbb::parallel_for(std::size_t{0}, (past - first + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t from = first + chunk * kChunk, size = past - from < kChunk ? past - from : kChunk;
    ::madvise(static_cast<std::byte*>(begin) + from, size, MADV_POPULATE_WRITE);
  });
#else
  static_cast<void>(begin);
  static_cast<void>(bytes);
#endif
}

/// Resizes an empty table like table.resize(size), with its memory populated first.
template <typename Row>
void resize_large(std::vector<Row>& table, std::size_t size) {
  table.reserve(size);
  populate(table.data(), size * sizeof(Row));
  table.resize(size);
}

/// The number of rows by which a row is prefetched before its use.
inline constexpr std::size_t kPrefetchAhead = 12;

/// Prefetches a row that will soon be read, because neighbours in space may lie far apart in a table. Does nothing for
/// a row past the end. A function that only prefetches has no effect in GCC's eyes, which drops calls that it does not
/// inline.
template <typename Table>
[[gnu::always_inline]] inline void prefetch(const Table& table, std::size_t row) {
  if (row >= table.size()) return;
  const auto* bytes = reinterpret_cast<const char*>(&table[row]);
  for (std::size_t at = 0; at < sizeof table[row]; at += 64) __builtin_prefetch(bytes + at);
  __builtin_prefetch(bytes + sizeof table[row] - 1);
}

/// Numbers the items of all rows of a table, in the order of the rows, on all threads. A `Sum` is a number, or a struct
/// with += that is zero when made. The numbers do not depend on the number of threads.
template <typename Sum>
class RowNumbers {
 public:
  /// `count(n)` returns the number of items of row n, for n from 0 to `rows` - 1. Numbers begin at `first`.
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

  /// Returns the number after the last item of the last row.
  const Sum& past() const { return before_.back(); }

  /// Calls `fill(n, next)` once for each row, in ascending order within a chunk. `next` is the number of the row's
  /// first item, and fill must leave it at the first number of the following row.
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
  std::vector<Sum> before_;  // the numbers before each chunk
};

}  // namespace meniscus
