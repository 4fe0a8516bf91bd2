// SPDX-License-Identifier: BSD-3-Clause
// Cuts a selection into words, quoted texts, brackets and operators, and reads the values after its words.
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

/// The tokens, the last of kind `end`. Words may hold anything but blanks, brackets, commas, double quotes and the
/// signs < > = ! & |; a single quote opens a quoted text only where a word would begin, so that O5' is a word. Throws
/// SelectionError for a quote that is not closed and for control characters.
std::vector<Token> tokens_of(std::string_view text);

/// One value of a list, with its place for messages.
struct SelectionValue {
  std::string text;
  std::size_t position = 0;
  bool quoted = false;
};

/// "CA+CB" is two values; "NA+" is one, since nothing follows the sign. Quoted values stay whole.
std::vector<SelectionValue> split_at_plus(const Token& token);

/// These throw SelectionError pointing into `text`.
std::vector<TextPattern> read_patterns(const std::vector<SelectionValue>& values);
std::vector<std::array<double, 2>> read_elements(std::string_view text, const std::vector<SelectionValue>& values);
std::vector<std::array<ResidueTest::Id, 2>> read_residue_ranges(std::string_view text,
                                                                const std::vector<SelectionValue>& values);
std::vector<std::array<double, 2>> read_number_ranges(std::string_view text, const std::vector<SelectionValue>& values,
                                                      bool whole);
double read_number(std::string_view text, const SelectionValue& value, bool whole);

}  // namespace meniscus
