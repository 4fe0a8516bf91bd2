// SPDX-License-Identifier: BSD-3-Clause
// One pass from left to right; nothing is looked at twice.
#include "core/structure/selection/selection_lexer.h"

#include "core/base/error.h"
#include "core/base/text.h"

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

}  // namespace meniscus
