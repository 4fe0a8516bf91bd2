// SPDX-License-Identifier: BSD-3-Clause
// Splits a selection into words, quoted texts, brackets and operators, and parses the values of keywords.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/structure/selection/selection_steps.h"

namespace meniscus {

enum class TokenKind : std::uint8_t { end, word, quoted, open, close, comma, compare, both, either, negate };

struct Token {
  TokenKind kind = TokenKind::end;
  std::string text;          ///< without quotes
  std::size_t position = 0;  ///< byte in the expression
};

/// Returns the tokens, of which the last has the kind `end`. Words may contain everything except blanks, brackets,
/// commas, double quotes and the signs < > = ! & |. A single quote opens a quoted text only at the beginning of a word,
/// so that O5' is a word. Throws SelectionError for a quote that is not closed and for control characters.
std::vector<Token> tokens_of(std::string_view text);

/// A value of a list, with its position for messages.
struct SelectionValue {
  std::string text;
  std::size_t position = 0;
  bool is_quoted = false;
};

/// Splits a word at plus signs. "CA+CB" has two values; "NA+" has one, because nothing follows the sign. A quoted text
/// is one value.
std::vector<SelectionValue> split_at_plus(const Token& token);

/// These functions parse values. They throw SelectionError with the position in `text`. whole: only integers are
/// allowed.
std::vector<TextPattern> read_patterns(const std::vector<SelectionValue>& values);
std::vector<std::array<double, 2>> read_elements(std::string_view text, const std::vector<SelectionValue>& values);
std::vector<std::array<ResidueTest::Id, 2>> read_residue_ranges(std::string_view text,
                                                                const std::vector<SelectionValue>& values);
std::vector<std::array<double, 2>> read_number_ranges(std::string_view text, const std::vector<SelectionValue>& values,
                                                      bool whole);
double read_number(std::string_view text, const SelectionValue& value, bool whole);

}  // namespace meniscus
