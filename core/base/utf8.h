// SPDX-License-Identifier: BSD-3-Clause
// UTF-8: its characters one by one, and those of them that steer what shows a text.
#pragma once

#include <cstddef>
#include <string_view>

namespace meniscus {

/// A character and the bytes it takes.
struct Character {
  char32_t code = 0;
  std::size_t bytes = 0;
};

/// The character that a text begins with, which is not empty; of 0 bytes where that is not UTF-8 (RFC 3629).
Character first_character(std::string_view text);

/// Whether all of the text is UTF-8.
bool is_utf8(std::string_view text);

/// Whether a character shows nothing, but steers a terminal or what is shown of the characters around it: controls of
/// ASCII and U+0080 to U+009F, marks of direction (Unicode's Bidi_Control), separators of lines and paragraphs.
bool is_control(char32_t code);

}  // namespace meniscus
