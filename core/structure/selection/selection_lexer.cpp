// SPDX-License-Identifier: BSD-3-Clause
// Splits a selection into tokens, and parses patterns, elements, numbers and ranges.
#include "core/structure/selection/selection_lexer.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parse_number.h"
#include "core/base/text.h"
#include "core/structure/element_tables.h"

namespace meniscus {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::string_view kWordEnds = " \t\r\n()<>=!&|,\"";

Token operator_at(std::string_view text, std::size_t position) {
  const auto token = [&](TokenKind kind, std::size_t length) {
    return Token{kind, std::string(text.substr(position, length)), position};
  };
  const char c = text[position];
  const char next = position + 1 < text.size() ? text[position + 1] : '\0';
  switch (c) {
    case '(':
      return token(TokenKind::open, 1);
    case ')':
      return token(TokenKind::close, 1);
    case ',':
      return token(TokenKind::comma, 1);
    case '&':
      return token(TokenKind::both, next == '&' ? 2 : 1);
    case '|':
      return token(TokenKind::either, next == '|' ? 2 : 1);
    case '!':
      return next == '=' ? token(TokenKind::compare, 2) : token(TokenKind::negate, 1);
    default:
      return token(TokenKind::compare, next == '=' ? 2 : 1);
  }
}

Token quoted_at(std::string_view text, std::size_t position) {
  const std::size_t close = text.find(text[position], position + 1);
  if (close == std::string_view::npos) {
    throw SelectionError("this quote is not closed", pointed_at(text, position));
  }
  return {TokenKind::quoted, std::string(text.substr(position + 1, close - position - 1)), position};
}

}  // namespace

std::vector<Token> tokens_of(std::string_view text) {
  std::vector<Token> tokens;
  std::size_t position = 0;
  while ((position = text.find_first_not_of(kBlanks, position)) != std::string_view::npos) {
    const char c = text[position];
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      throw SelectionError("a control character has no meaning here", pointed_at(text, position));
    }
    std::size_t length = 0;
    if (c == '"' || c == '\'') {
      tokens.push_back(quoted_at(text, position));
      length = tokens.back().text.size() + 2;
    } else if (kWordEnds.find(c) != std::string_view::npos) {
      tokens.push_back(operator_at(text, position));
      length = tokens.back().text.size();
    } else {
      length = std::min(text.find_first_of(kWordEnds, position), text.size()) - position;
      tokens.push_back({TokenKind::word, std::string(text.substr(position, length)), position});
    }
    position += length;
  }
  tokens.push_back({TokenKind::end, "", text.size()});
  return tokens;
}

namespace {

/// Both ends of a range as written. A single value has no second end.
struct Ends {
  SelectionValue low;
  std::optional<SelectionValue> high;
};

SelectionValue part(const SelectionValue& value, std::size_t first, std::size_t length) {
  return {value.text.substr(first, length), value.position + first, value.is_quoted};
}

/// Returns the place of the sign that separates a range, or npos. A minus sign does so only after a digit or an
/// insertion code: -5--1 is -5 to -1, and 1e-3 is one number.
std::size_t range_sign(const std::string& text, bool with_letters) {
  for (std::size_t n = 1; n < text.size(); ++n) {
    if (text[n] == ':') return n;
    const auto before = static_cast<unsigned char>(text[n - 1]);
    if (text[n] == '-' && (std::isdigit(before) || before == '.' || (with_letters && std::isalpha(before)))) return n;
  }
  return std::string::npos;
}

/// Parses values and ranges: A, A-B, A:B, and "A to B", which is given as three values.
std::vector<Ends> ends_of(std::string_view text, const std::vector<SelectionValue>& values, bool with_letters) {
  std::vector<Ends> all;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const SelectionValue& value = values[n];
    if (!value.is_quoted && (value.text == "to" || value.text == "TO")) {
      if (all.empty() || all.back().high || n + 1 == values.size()) {
        throw SelectionError("'to' goes between two values, as in 5 to 10", pointed_at(text, value.position));
      }
      all.back().high = values[++n];
      continue;
    }
    const std::size_t sign = range_sign(value.text, with_letters);
    if (sign == std::string::npos) {
      all.push_back({value, std::nullopt});
    } else {
      all.push_back({part(value, 0, sign), part(value, sign + 1, std::string::npos)});
    }
  }
  return all;
}

[[noreturn]] void refuse_backwards(std::string_view text, const Ends& ends) {
  throw SelectionError(
      fmt::format("the range runs backwards, from {} to {}", in_quotes(ends.low.text), in_quotes(ends.high->text)),
      pointed_at(text, ends.low.position));
}

ResidueTest::Id residue_id(std::string_view text, const SelectionValue& value) {
  std::int32_t number = 0;
  const char* const last = value.text.data() + value.text.size();
  const auto [end, error] = std::from_chars(value.text.data(), last, number);
  const bool with_code = end + 1 == last && std::isalpha(static_cast<unsigned char>(*end));
  if (error != std::errc() || (end != last && !with_code)) {
    throw SelectionError(
        fmt::format("{} is not a residue number; write one such as 52, -3, 52A or 5-10", in_quotes(value.text)),
        pointed_at(text, value.position));
  }
  return {number, with_code ? *end : ' '};
}

}  // namespace

std::vector<SelectionValue> split_at_plus(const Token& token) {
  if (token.kind == TokenKind::quoted) return {{token.text, token.position, true}};
  std::vector<SelectionValue> values;
  std::size_t first = 0;
  for (std::size_t n = 1; n + 1 < token.text.size(); ++n) {
    if (token.text[n] != '+' || n == first) continue;
    values.push_back({token.text.substr(first, n - first), token.position + first, false});
    first = n + 1;
  }
  values.push_back({token.text.substr(first), token.position + first, false});
  return values;
}

std::vector<TextPattern> read_patterns(const std::vector<SelectionValue>& values) {
  std::vector<TextPattern> patterns;
  for (const SelectionValue& value : values) {
    patterns.push_back({value.text, !value.is_quoted && value.text.find_first_of("*?") != std::string::npos});
  }
  return patterns;
}

std::vector<std::array<double, 2>> read_elements(std::string_view text, const std::vector<SelectionValue>& values) {
  std::vector<std::array<double, 2>> elements;
  for (const SelectionValue& value : values) {
    const double element = element_of_symbol(value.text);
    if (element == 0.0) {
      throw SelectionError(fmt::format("{} is not an element", in_quotes(value.text)),
                           pointed_at(text, value.position));
    }
    elements.push_back({element, element});
  }
  return elements;
}

std::vector<std::array<ResidueTest::Id, 2>> read_residue_ranges(std::string_view text,
                                                                const std::vector<SelectionValue>& values) {
  std::vector<std::array<ResidueTest::Id, 2>> ranges;
  for (const Ends& ends : ends_of(text, values, true)) {
    const ResidueTest::Id low = residue_id(text, ends.low);
    const ResidueTest::Id high = ends.high ? residue_id(text, *ends.high) : low;
    if (high < low) refuse_backwards(text, ends);
    ranges.push_back({low, high});
  }
  return ranges;
}

double read_number(std::string_view text, const SelectionValue& value, bool whole) {
  double number = 0.0;
  if (!parse_number(value.text, number)) {
    throw SelectionError(fmt::format("{} is not a finite number", in_quotes(value.text)),
                         pointed_at(text, value.position));
  }
  if (whole && number != std::floor(number)) {
    throw SelectionError(fmt::format("{} is not a whole number", in_quotes(value.text)),
                         pointed_at(text, value.position));
  }
  return number;
}

std::vector<std::array<double, 2>> read_number_ranges(std::string_view text, const std::vector<SelectionValue>& values,
                                                      bool whole) {
  std::vector<std::array<double, 2>> ranges;
  for (const Ends& ends : ends_of(text, values, false)) {
    const double low = read_number(text, ends.low, whole);
    const double high = ends.high ? read_number(text, *ends.high, whole) : low;
    if (high < low) refuse_backwards(text, ends);
    ranges.push_back({low, high});
  }
  return ranges;
}

}  // namespace meniscus
