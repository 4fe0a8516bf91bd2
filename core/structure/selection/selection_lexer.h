// SPDX-License-Identifier: BSD-3-Clause
// Cuts a selection into words, quoted texts, brackets and operators.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

enum class TokenKind : std::uint8_t { end, word, quoted, open, close, comma, compare, both, either, negate };

struct Token {
  TokenKind kind = TokenKind::end;
  std::string text;          ///< without quotes
  std::size_t position = 0;  ///< byte in the expression
};

/// The tokens, the last of kind `end`. Words may hold anything but blanks, brackets, commas, double quotes and the
/// signs < > = ! & |; a single quote opens a quoted text only where a word would begin, so that O5' is a word. Throws
/// SelectionError for a quote that is not closed and for control characters.
std::vector<Token> tokens_of(std::string_view text);

}  // namespace meniscus
