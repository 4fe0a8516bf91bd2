// SPDX-License-Identifier: BSD-3-Clause
// Parses selections by recursive descent into a flat list of steps, so that only brackets and prefixes are nested.
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/selection/foreign_selections.h"
#include "core/structure/selection/selection.h"
#include "core/structure/selection/selection_lexer.h"
#include "core/structure/selection/selection_steps.h"
#include "core/structure/selection/selection_words.h"

namespace meniscus {
namespace {

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text), tokens_(tokens_of(text)) {}

  std::vector<SelectionStep> parse() {
    if (token().kind == TokenKind::end) fail("the selection is empty; 'all' selects every atom");
    parse_or();
    if (token().kind == TokenKind::close) fail("this bracket closes nothing");
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
      if (token().kind != TokenKind::word || lower(token().text) != "of") {
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
    if (token().kind == TokenKind::word && lower(token().text) == "of") take();
    parse_operand(keyword);
    steps_.push_back(WithinStep{distance, includes_set});
  }

  void parse_same(const Token& keyword) {
    const std::string what = lower(token().text);
    const bool chains = what == "chain" || what == "segid";
    if (token().kind != TokenKind::word || (!chains && what != "residue"))
      fail("'residue as' or 'chain as' is expected here");
    take();
    if (token().kind != TokenKind::word || lower(token().text) != "as") fail("'as' is expected here");
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

  static std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
  }

  std::string_view text_;
  std::vector<Token> tokens_;
  std::size_t place_ = 0;
  int depth_ = 0;
  std::vector<SelectionStep> steps_;
};

}  // namespace

Selection parse_selection(std::string_view text) {
  if (text.size() > kLongestSelection) {
    throw SelectionError(fmt::format("the selection has {} bytes; at most {} are read", with_thousands(text.size()),
                                     with_thousands(kLongestSelection)),
                         pointed_at(text, kLongestSelection));
  }
  Selection selection;
  selection.text_ = text;
  selection.steps_ = std::make_shared<const SelectionSteps>(SelectionSteps{Parser(text).parse()});
  return selection;
}

}  // namespace meniscus
