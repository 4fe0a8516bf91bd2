// SPDX-License-Identifier: BSD-3-Clause
// Decodes UTF-8 and recognizes control characters.
#include "core/base/utf8.h"

namespace meniscus {

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text[n]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >> 5 == 6 ? 2 : lead >> 4 == 14 ? 3 : lead >> 3 == 30 ? 4 : 0;
  if (bytes == 0 || bytes > text.size()) return {};
  char32_t code = lead & (0x7fu >> bytes);
  for (std::size_t n = 1; n < bytes; ++n) {
    if (byte(n) >> 6 != 2) return {};
    code = code << 6 | (byte(n) & 0x3fu);
  }
  constexpr char32_t kLeast[] = {0x80, 0x800, 0x10000};  // with 2, 3 and 4 bytes; smaller codes have a shorter form
  const bool is_surrogate = code >= 0xd800 && code < 0xe000;
  if (code < kLeast[bytes - 2] || is_surrogate || code > 0x10ffff) return {};
  return {code, bytes};
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t bytes = first_character(text).bytes;
    if (bytes == 0) return false;
    text.remove_prefix(bytes);
  }
  return true;
}

bool is_control(char32_t code) {
  const auto is_within = [code](char32_t first, char32_t last) { return code >= first && code <= last; };
  return code < 0x20 || is_within(0x7f, 0x9f) || code == 0x61c || is_within(0x200e, 0x200f) ||
         is_within(0x2028, 0x202e) || is_within(0x2066, 0x2069);
}

}  // namespace meniscus
