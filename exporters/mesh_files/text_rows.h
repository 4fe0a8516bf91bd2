// SPDX-License-Identifier: BSD-3-Clause
// Rows of text, formatted in chunks on all cores.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace meniscus {

/// The beginning, and put_row(n, out) for each n behind it, in order.
template <typename PutRow>
std::string text_of_rows(std::string beginning, std::size_t count, const PutRow& put_row) {
  constexpr std::size_t kChunk = 4096;
  std::vector<fmt::memory_buffer> parts((count + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
    const std::size_t past = std::min(count, (part + 1) * kChunk);
    for (std::size_t n = part * kChunk; n < past; ++n) put_row(n, std::back_inserter(parts[part]));
  });
  std::size_t size = beginning.size();
  for (const auto& part : parts) size += part.size();
  beginning.reserve(size);
  for (const auto& part : parts) beginning.append(part.data(), part.size());
  return beginning;
}

}  // namespace meniscus
