// SPDX-License-Identifier: BSD-3-Clause
// Decoding of UTF-8, and the control characters of Unicode.
#pragma once

#include <cstddef>
#include <string_view>

namespace meniscus {

/// A character and its number of bytes in UTF-8.
struct Character {
  char32_t code = 0;
  std::size_t bytes = 0;
};

/// Decodes the first character of a text that is not empty. It has 0 bytes if the text does not begin with UTF-8 (RFC
/// 3629).
Character first_character(std::string_view text);

/// True if the whole text is UTF-8.
bool is_utf8(std::string_view text);

/// True if a character is invisible but controls a terminal or the display of other characters: control characters of
/// ASCII and U+0080 to U+009F, marks of direction (Unicode's Bidi_Control), and separators of lines and paragraphs.
bool is_control(char32_t code);

}  // namespace meniscus
