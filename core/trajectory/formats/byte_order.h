// SPDX-License-Identifier: BSD-3-Clause
// Numbers in bytes of either order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace meniscus {

/// The number that stands at `bytes`, which need not be aligned.
template <typename Number>
Number number_at(const std::byte* bytes, std::endian order) {
  std::array<std::byte, sizeof(Number)> copy;
  std::memcpy(copy.data(), bytes, sizeof(Number));
  if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<Number>(copy);
}

}  // namespace meniscus
