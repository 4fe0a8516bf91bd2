// SPDX-License-Identifier: BSD-3-Clause
// Cuts a selection into tokens and parses them into steps in postfix order.
#include "core/structure/selection/selection.h"
#include "core/structure/selection/selection_steps.h"

#include <cctype>
#include <charconv>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/element_tables.h"
#include "core/structure/selection/selection_words.h"

namespace meniscus {
namespace {

enum class TokenKind : std::uint8_t { end, word, quoted, open, close, comma, compare, both, either, negate };

struct Token {
  TokenKind kind = TokenKind::end;
  std::string text;          ///< without quotes
  std::size_t position = 0;  ///< byte in the expression
};

/// A value of a list, with its position for messages.
struct SelectionValue {
  std::string text;
  std::size_t position = 0;
  bool is_quoted = false;
};

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
  if (close == std::string_view::npos) throw SelectionError("this quote is not closed", pointed_at(text, position));
  return {TokenKind::quoted, std::string(text.substr(position + 1, close - position - 1)), position};
}

/// Returns the tokens. The last one has the kind `end`. Words may contain everything except blanks, brackets,
/// commas, double quotes and the signs < > = ! & |. A single quote opens a quoted text only at the beginning of a word,
/// so that O5' is a word. Throws SelectionError for a quote that is not closed and for control characters.
std::vector<Token> tokens_of(std::string_view text) {
  std::vector<Token> tokens;
  std::size_t position = 0;
  while ((position = text.find_first_not_of(kBlanks, position)) != std::string_view::npos) {
    const char c = text[position];
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      throw SelectionError("a control character has no meaning here", pointed_at(text, position));
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
      if (all.empty() || all.back().high || n + 1 == values.size())
        throw SelectionError("'to' goes between two values, as in 5 to 10", pointed_at(text, value.position));
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
  if (error != std::errc() || (end != last && !with_code))
    throw SelectionError(
        fmt::format("{} is not a residue number; write one such as 52, -3, 52A or 5-10", in_quotes(value.text)),
        pointed_at(text, value.position));
  return {number, with_code ? *end : ' '};
}

/// Splits a word at plus signs. "CA+CB" has two values; "NA+" has one, because nothing follows the sign. A quoted text
/// is one value.
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

/// These functions parse values. They throw SelectionError with the position in `text`. whole: integers only.
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
    if (element == 0.0)
      throw SelectionError(fmt::format("{} is not an element", in_quotes(value.text)),
                           pointed_at(text, value.position));
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
  if (!parse_number(value.text, number))
    throw SelectionError(fmt::format("{} is not a finite number", in_quotes(value.text)),
                         pointed_at(text, value.position));
  if (whole && number != std::floor(number))
    throw SelectionError(fmt::format("{} is not a whole number", in_quotes(value.text)),
                         pointed_at(text, value.position));
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

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text), tokens_(tokens_of(text)) {}

  std::vector<SelectionStep> parse() {
    if (token().kind == TokenKind::end) fail("the selection is empty; 'all' selects every atom");
    parse_or();
    if (token().kind == TokenKind::close) fail("this bracket has no opening bracket");
    if (token().kind != TokenKind::end)
      fail(fmt::format("'and' or 'or' is missing before {}", in_quotes(token().text)));
    return std::move(steps_);
  }

 private:
  const Token& token() const { return tokens_[place_]; }
  Token take() { return tokens_[place_ + 1 < tokens_.size() ? place_++ : place_]; }

  [[noreturn]] void fail(const std::string& sentence) const { fail_at(token().position, sentence); }
  [[noreturn]] void fail_at(std::size_t position, const std::string& sentence) const {
    throw SelectionError(sentence, pointed_at(text_, position));
  }

  const SelectionWord* word() const {
    return token().kind == TokenKind::word ? find_selection_word(token().text) : nullptr;
  }
  bool at(std::string_view operation, TokenKind sign) const {
    const SelectionWord* found = word();
    return token().kind == sign || (found && found->words == operation);
  }
  bool at_and() const { return at("and", TokenKind::both); }
  bool at_or() const { return at("or", TokenKind::either); }
  bool at_not() const { return at("not", TokenKind::negate); }

  void parse_or() {
    parse_and();
    while (at_or()) {
      take();
      parse_and();
      steps_.push_back(OrStep{});
    }
  }

  void parse_and() {
    parse_unary();
    while (at_and()) {
      take();
      parse_unary();
      steps_.push_back(AndStep{});
    }
  }

  void parse_unary() {
    if (++depth_ > kDeepestSelection) fail(fmt::format("nested more than {} levels deep", kDeepestSelection));
    if (at_not()) {
      take();
      parse_unary();
      steps_.push_back(NotStep{});
    } else if (token().kind == TokenKind::open) {
      parse_brackets();
      parse_nearness();
    } else {
      parse_word();
      parse_nearness();
    }
    --depth_;
  }

  /// Parses a distance after a set. `SET within 5 of SET` selects the atoms of the first set near the second; `SET
  /// around 5` selects the atoms near the set.
  void parse_nearness() {
    while (word() && word()->kind == WordKind::distance) {
      const bool includes_set = word()->which == 1;
      const Token keyword = take();
      const double distance = parse_limit();
      if (token().kind != TokenKind::word || lower_case(token().text) != "of") {
        steps_.push_back(WithinStep{distance, includes_set});
        continue;
      }
      take();
      parse_operand(keyword);
      steps_.push_back(WithinStep{distance, includes_set});
      steps_.push_back(AndStep{});
    }
  }

  void parse_brackets() {
    const std::size_t position = take().position;
    parse_or();
    if (token().kind == TokenKind::end) fail_at(position, "this bracket is not closed");
    if (token().kind != TokenKind::close)
      fail(fmt::format("'and' or 'or' is missing before {}", in_quotes(token().text)));
    take();
  }

  void parse_word() {
    const SelectionWord* found = word();
    if (!found) refuse_unknown();
    const Token keyword = take();
    const auto field = static_cast<AtomField>(found->which);
    switch (found->kind) {
      case WordKind::flag:
        steps_.push_back(FlagTest{static_cast<AtomFlag>(found->which)});
        break;
      case WordKind::text:
        steps_.push_back(TextTest{field, read_patterns(values_of(keyword))});
        break;
      case WordKind::element:
        steps_.push_back(NumberTest{field, read_elements(text_, values_of(keyword))});
        break;
      case WordKind::residue:
      case WordKind::whole:
      case WordKind::number:
        parse_numbers(keyword, field, found->kind);
        break;
      case WordKind::distance:
        parse_distance(keyword, found->which == 1);
        break;
      case WordKind::group:
        parse_operand(keyword);
        if (found->which == 2)
          steps_.push_back(FirstStep{});
        else
          steps_.push_back(WholeStep{found->which == 1});
        break;
      case WordKind::same:
        parse_same(keyword);
        break;
      case WordKind::operation:
        fail_at(keyword.position, fmt::format("a selection is missing before {}", in_quotes(keyword.text)));
    }
  }

  [[noreturn]] void refuse_unknown() const {
    if (token().kind == TokenKind::end) fail("a selection is missing at the end");
    if (token().kind != TokenKind::word) fail(fmt::format("a selection is missing before {}", in_quotes(token().text)));
    if (const std::string advice = advice_on_foreign_selection(token().text); !advice.empty()) fail(advice);
    const std::string_view nearest = nearest_selection_word(token().text);
    fail(fmt::format("{} is not a selection keyword{}", in_quotes(token().text),
                     nearest.empty() ? std::string("; see meniscus help selections")
                                     : fmt::format("; did you mean '{}'?", nearest)));
  }

  /// Parses the list after a keyword: all words and quoted texts up to an operation, a bracket or the end.
  std::vector<SelectionValue> values_of(const Token& keyword) {
    std::vector<SelectionValue> values;
    while (true) {
      const Token& next = token();
      if (next.kind == TokenKind::comma && !values.empty()) {
        take();
        if (token().kind != TokenKind::word && token().kind != TokenKind::quoted) fail("a value is missing here");
        continue;
      }
      if (next.kind != TokenKind::word && next.kind != TokenKind::quoted) break;
      const SelectionWord* known = word();
      if (known && (known->kind == WordKind::operation || (known->kind == WordKind::distance && !values.empty())))
        break;
      if (known && next.text.size() > 1) {
        fail(fmt::format("{} is a keyword; put 'and' or 'or' before it, or quotes around it if it is a value",
                         in_quotes(next.text)));
      }
      const std::vector<SelectionValue> parts = split_at_plus(next);
      values.insert(values.end(), parts.begin(), parts.end());
      take();
    }
    if (values.empty()) fail(fmt::format("a value is missing after {}", in_quotes(keyword.text)));
    return values;
  }

  void parse_numbers(const Token& keyword, AtomField field, WordKind kind) {
    if (token().kind == TokenKind::compare) {
      const Comparison comparison = comparison_of(take().text);
      const Token value = take();
      if (value.kind != TokenKind::word) fail_at(value.position, "a number is missing here");
      const double number = read_number(text_, {value.text, value.position}, kind != WordKind::number);
      steps_.push_back(CompareTest{field, comparison, number});
    } else if (kind == WordKind::residue) {
      steps_.push_back(ResidueTest{read_residue_ranges(text_, values_of(keyword))});
    } else {
      steps_.push_back(NumberTest{field, read_number_ranges(text_, values_of(keyword), kind == WordKind::whole)});
    }
  }

  static Comparison comparison_of(std::string_view sign) {
    if (sign == "<") return Comparison::less;
    if (sign == "<=") return Comparison::less_or_equal;
    if (sign == ">") return Comparison::greater;
    if (sign == ">=") return Comparison::greater_or_equal;
    return sign == "!=" ? Comparison::not_equal : Comparison::equal;
  }

  /// Parses a distance in Å.
  double parse_limit() {
    const Token value = take();
    if (value.kind != TokenKind::word) fail_at(value.position, "a distance in Å is missing here");
    const double distance = read_number(text_, {value.text, value.position}, false);
    if (distance < 0.0) fail_at(value.position, "a distance cannot be negative");
    return distance;
  }

  void parse_distance(const Token& keyword, bool includes_set) {
    const double distance = parse_limit();
    if (token().kind == TokenKind::word && lower_case(token().text) == "of") take();
    parse_operand(keyword);
    steps_.push_back(WithinStep{distance, includes_set});
  }

  void parse_same(const Token& keyword) {
    const std::string what = lower_case(token().text);
    const bool chains = what == "chain" || what == "segid";
    if (token().kind != TokenKind::word || (!chains && what != "residue"))
      fail("'residue as' or 'chain as' is expected here");
    take();
    if (token().kind != TokenKind::word || lower_case(token().text) != "as") fail("'as' is expected here");
    take();
    parse_operand(keyword);
    steps_.push_back(WholeStep{chains});
  }

  /// Parses the set after a prefix. Programs differ in whether `byres A and B` means (byres A) and B or byres (A and
  /// B), so that brackets are required here.
  void parse_operand(const Token& keyword) {
    const std::size_t position = token().position;
    const bool in_brackets = token().kind == TokenKind::open;
    parse_unary();
    if (!in_brackets && (at_and() || at_or())) {
      fail_at(position, fmt::format("it is unclear where the selection of {} ends; put brackets around it",
                                    in_quotes(keyword.text)));
    }
  }

  std::string_view text_;
  std::vector<Token> tokens_;
  std::size_t place_ = 0;
  int depth_ = 0;
  std::vector<SelectionStep> steps_;
};

}  // namespace

Selection parse_selection(std::string_view text) {
  if (text.size() > kLongestSelection)
    throw SelectionError(fmt::format("the selection has {} bytes; at most {} are read", with_thousands(text.size()),
                                     with_thousands(kLongestSelection)),
                         pointed_at(text, kLongestSelection));
  Selection selection;
  selection.text_ = text;
  selection.steps_ = std::make_shared<const SelectionSteps>(SelectionSteps{Parser(text).parse()});
  return selection;
}

std::optional<SelectionAndText> selection_and_text(std::string_view text) {
  for (std::size_t sign = text.find('='); sign != std::string_view::npos; sign = text.find('=', sign + 1)) {
    try {
      return SelectionAndText{parse_selection(text.substr(0, sign)), text.substr(sign + 1)};
    } catch (const SelectionError&) {
      continue;  // this sign is part of a comparison
    }
  }
  return std::nullopt;
}

}  // namespace meniscus
