// SPDX-License-Identifier: BSD-3-Clause
// Small pieces of message text: escaped quotes from foreign files, and counts as people write them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace meniscus {

/// The text with control characters as \xNN, so that a foreign file cannot steer a terminal: those of ASCII, and U+0080
/// to U+009F, which steer some terminals as well. All other UTF-8 passes.
std::string escaped(std::string_view text);

/// At most `bytes` bytes of the text, escaped, and "..." in place of the rest.
std::string shortened(std::string_view text, std::size_t bytes);

/// 'text' in quotes, escaped, at most 40 bytes of it.
std::string in_quotes(std::string_view text);

/// The text in lines of at most `width` letters, broken at blanks; all but the first begin with `indent` blanks, which
/// count for no width. A longer word stands in a line of its own.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent = 0);

/// 5469 -> "5,469".
std::string with_thousands(std::uint64_t count);

/// One word of a POSIX shell, whatever the text holds.
std::string shell_word(std::string_view text);

/// Two lines: the text, and a caret under byte `position` of it (at most its size). Of a long text only a window around
/// the place is shown; control characters are escaped, and UTF-8 counts by character.
std::string pointed_at(std::string_view text, std::size_t position);

}  // namespace meniscus
