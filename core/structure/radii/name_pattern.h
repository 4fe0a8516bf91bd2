// SPDX-License-Identifier: BSD-3-Clause
// The patterns that tables of atom types use for names: the part of awk's regular expressions that occurs there.
#pragma once

#include <bitset>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// Alternatives "A|B", characters, ".", sets "[12A-D]", "\" before a character, and after each of these "*", "+" or
/// "?". A lone "*" matches everything. Matching takes time proportional to pattern times text.
class NamePattern {
 public:
  /// Throws Error with a sentence if the pattern uses something else.
  explicit NamePattern(std::string_view text);

  /// Does the whole name match?
  bool matches(std::string_view name) const;
  /// Does it match a name of hydrogen, such as "HB1" or "1H"?
  bool matches_hydrogen() const { return matches("H") || matches("HB1") || matches("1H"); }

 private:
  struct Piece {
    std::bitset<256> characters;
    bool optional = false;  // ? or *
    bool repeated = false;  // + or *
  };
  static std::vector<Piece> pieces_of(std::string_view alternative);
  static bool matches(const std::vector<Piece>& pieces, std::string_view name);

  std::vector<std::vector<Piece>> alternatives_;
};

}  // namespace meniscus
