// SPDX-License-Identifier: BSD-3-Clause
// Escaping, quoting, grouping of digits, and carets.
#include "core/base/text.h"

#include <algorithm>

#include <fmt/format.h>

namespace meniscus {

std::string escaped(std::string_view text) {
  const auto byte_at = [&](std::size_t n) { return n < text.size() ? static_cast<unsigned char>(text[n]) : 0x20U; };
  std::string result;
  for (std::size_t n = 0; n < text.size(); ++n) {
    const unsigned byte = byte_at(n), next = byte_at(n + 1);
    if (byte < 0x20 || byte == 0x7f) {
      result += fmt::format("\\x{:02x}", byte);
    } else if (byte == 0xc2 && next >= 0x80 && next < 0xa0) {
      result += fmt::format("\\x{:02x}\\x{:02x}", byte, next);
      ++n;
    } else {
      result += text[n];
    }
  }
  return result;
}

std::string shortened(std::string_view text, std::size_t bytes) {
  return escaped(text.substr(0, bytes)) + (text.size() > bytes ? "..." : "");
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  return fmt::format("'{}'", shortened(text, kLongest));
}

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  std::string lines;
  std::size_t used = 0;
  while (!text.empty()) {
    const std::size_t blank = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, blank);
    text.remove_prefix(std::min(text.size(), blank + 1));
    if (word.empty()) continue;
    const auto letters =
        static_cast<std::size_t>(std::count_if(word.begin(), word.end(), [](char c) { return (c & 0xc0) != 0x80; }));
    if (used > 0 && used + 1 + letters > width) {
      lines.append("\n").append(indent, ' ');
      used = 0;
    }
    if (used > 0) lines += ' ';
    lines += word;
    used += letters + (used > 0 ? 1 : 0);
  }
  return lines;
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

std::string shell_word(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

std::string pointed_at(std::string_view text, std::size_t position) {
  constexpr std::size_t kBefore = 50, kAfter = 30;
  const auto continues = [&](std::size_t n) { return n < text.size() && (text[n] & 0xc0) == 0x80; };  // inside UTF-8
  while (position > 0 && continues(position)) --position;  // a character is shown before the caret or above it
  std::size_t first = position > kBefore ? position - kBefore : 0;
  std::size_t last = std::min(text.size(), position + kAfter);
  while (first < position && continues(first)) ++first;
  while (continues(last)) ++last;
  const std::string before = fmt::format("{}{}", first > 0 ? "..." : "", escaped(text.substr(first, position - first)));
  const std::string after =
      fmt::format("{}{}", escaped(text.substr(position, last - position)), last < text.size() ? "..." : "");
  const auto width = std::count_if(before.begin(), before.end(), [](char c) { return (c & 0xc0) != 0x80; });
  return fmt::format("{}{}\n{:{}}^", before, after, "", width);
}

}  // namespace meniscus
