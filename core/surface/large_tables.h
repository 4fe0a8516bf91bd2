// SPDX-License-Identifier: BSD-3-Clause
// Tables of many megabytes whose memory all threads ask the system for, not the one that lengthens them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <sys/mman.h>
#include <tbb/parallel_for.h>

namespace meniscus {

/// Asks for new memory of [begin, begin + bytes) now, chunk by chunk on all threads: page by page, when it is first
/// written, takes more time, and one thread's. Nothing changes where the memory is there already, or where the system
/// (before Linux 5.14) knows no such request.
inline void populate(void* begin, std::size_t bytes) {
#ifdef MADV_POPULATE_WRITE
  constexpr std::size_t kPage = 4096, kChunk = 1 << 20, kWorthIt = 32 << 20;
  if (bytes < kWorthIt) return;
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::size_t first = (address + kPage - 1) / kPage * kPage - address;  // of whole pages, from `begin`
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

/// What table.resize(size) does to an empty table.
template <typename Row>
void resize_large(std::vector<Row>& table, std::size_t size) {
  table.reserve(size);
  populate(table.data(), size * sizeof(Row));
  table.resize(size);
}

}  // namespace meniscus
