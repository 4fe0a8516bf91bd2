// SPDX-License-Identifier: BSD-3-Clause
// Escaping, quoting and grouping of digits.
#include "core/base/text.h"

#include <fmt/format.h>

namespace meniscus {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      result += fmt::format("\\x{:02x}", byte);
    } else {
      result += c;
    }
  }
  return result;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  return fmt::format("'{}{}'", escaped(text.substr(0, kLongest)), text.size() > kLongest ? "..." : "");
}

std::string with_thousands(std::uint64_t count) {
  const std::string digits = std::to_string(count);
  std::string grouped;
  for (std::size_t n = 0; n < digits.size(); ++n) {
    if (n > 0 && (digits.size() - n) % 3 == 0) grouped += ',';
    grouped += digits[n];
  }
  return grouped;
}

}  // namespace meniscus
