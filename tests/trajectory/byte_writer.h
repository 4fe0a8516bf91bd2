// SPDX-License-Identifier: BSD-3-Clause
// Builds the bytes of small binary files.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <string_view>

namespace meniscus::test {

class ByteWriter {
 public:
  explicit ByteWriter(std::endian order) : order_(order) {}

  template <typename Number>
  ByteWriter& put(Number number) {
    auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    if (order_ != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    text_.append(bytes.data(), bytes.size());
    return *this;
  }

  ByteWriter& put_text(std::string_view text) {
    text_ += text;
    return *this;
  }

  const std::string& bytes() const { return text_; }

 private:
  std::endian order_;
  std::string text_;
};

}  // namespace meniscus::test
