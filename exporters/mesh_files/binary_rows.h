// SPDX-License-Identifier: BSD-3-Clause
// Numbers one behind another as the bytes of a file; the machine is little-endian, as the formats are.
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace meniscus {

static_assert(std::endian::native == std::endian::little);

class BinaryRows {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  template <class T>
  void put_all(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto more = std::as_bytes(values);
    bytes_.insert(bytes_.end(), more.begin(), more.end());
  }
  void put_text(std::string_view text) { put_all(std::span<const char>(text)); }
  /// Up to a multiple of `size`.
  void pad(std::size_t size, char with) {
    while (bytes_.size() % size != 0) put(with);
  }

  std::size_t size() const { return bytes_.size(); }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace meniscus
