// SPDX-License-Identifier: BSD-3-Clause
// Looks radii up by name, from exact names to general ones, and matches patterns by following all ways at once.
#include "core/structure/radii/radii_file.h"

#include <cctype>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/residue_names.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

constexpr std::size_t kLongestPattern = 200;

[[noreturn]] void refuse(std::string_view text, const char* why) {
  throw Error(fmt::format("the pattern {} {}", in_quotes(text), why));
}

/// Returns the characters of "[...]", whose opening bracket is at `place`. `place` becomes that of the closing bracket.
std::bitset<256> set_at(std::string_view text, std::size_t& place) {
  const std::size_t close = text.find(']', place + 2);
  if (close == std::string_view::npos) refuse(text, "has a bracket that is not closed");
  std::bitset<256> characters;
  const bool inverted = text[place + 1] == '^';
  for (std::size_t n = place + (inverted ? 2 : 1); n < close; ++n) {
    const auto first = static_cast<unsigned char>(text[n]);
    unsigned char last = first;
    if (n + 2 < close && text[n + 1] == '-') {
      last = static_cast<unsigned char>(text[n + 2]);
      n += 2;
    }
    for (unsigned c = first; c <= last; ++c) characters.set(c);
  }
  place = close;
  return inverted ? ~characters : characters;
}

}  // namespace

NamePattern::NamePattern(std::string_view text) {
  if (text.size() > kLongestPattern) refuse(text, "is too long");
  if (text == "*") text = ".*";
  std::size_t first = 0;
  for (std::size_t n = 0; n <= text.size(); ++n) {
    if (n + 1 < text.size() && text[n] == '\\') {
      ++n;
    } else if (n == text.size() || text[n] == '|') {
      alternatives_.push_back(pieces_of(text.substr(first, n - first)));
      first = n + 1;
    }
  }
}

std::vector<NamePattern::Piece> NamePattern::pieces_of(std::string_view alternative) {
  std::vector<Piece> pieces;
  for (std::size_t n = 0; n < alternative.size(); ++n) {
    const char c = alternative[n];
    if (c == '*' || c == '+' || c == '?') {
      if (pieces.empty()) refuse(alternative, "begins with a repetition sign");
      pieces.back().is_optional |= c != '+';
      pieces.back().is_repeated |= c != '?';
      continue;
    }
    Piece piece;
    if (c == '[') {
      piece.characters = set_at(alternative, n);
    } else if (c == '.') {
      piece.characters.set();
    } else if (c == '(' || c == ')' || c == '{' || c == '^' || c == '$') {
      refuse(alternative, "uses brackets or anchors, which are not read");
    } else {
      if (c == '\\' && ++n == alternative.size()) refuse(alternative, "ends in a backslash");
      piece.characters.set(static_cast<unsigned char>(alternative[n]));
    }
    pieces.push_back(piece);
  }
  return pieces;
}

bool NamePattern::matches(std::string_view name) const {
  for (const std::vector<Piece>& pieces : alternatives_) {
    if (matches(pieces, name)) return true;
  }
  return false;
}

bool NamePattern::matches(const std::vector<Piece>& pieces, std::string_view name) {
  std::vector<bool> at(pieces.size() + 1);  // entry p: true if the name so far may end after p pieces
  at[0] = true;
  const auto skip_optional = [&] {
    for (std::size_t p = 0; p < pieces.size(); ++p) at[p + 1] = at[p + 1] || (at[p] && pieces[p].is_optional);
  };
  skip_optional();
  for (const char c : name) {
    std::vector<bool> next(at.size());
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      if (!pieces[p].characters[static_cast<unsigned char>(c)]) continue;
      if (at[p] || (at[p + 1] && pieces[p].is_repeated)) next[p + 1] = true;
    }
    at = std::move(next);
    skip_optional();
  }
  return at.back();
}

namespace {

std::string key(const std::string& residue, const std::string& atom) { return residue + ' ' + atom; }

bool is_hydrogen_name(const std::string& name) {
  const std::size_t letter = name.find_first_not_of("0123456789");
  return letter != std::string::npos && name[letter] == 'H';
}

}  // namespace

void RadiiTable::add(const std::string& residue, const std::string& atom, const Entry& entry) {
  names_[key(residue, atom)] = entry;
  const std::string canonical = canonical_residue(residue);
  names_.try_emplace(key(canonical, canonical_atom(canonical, atom)), entry);
  has_hydrogens_ = has_hydrogens_ || is_hydrogen_name(atom);
}

void RadiiTable::add(NamePattern residue, NamePattern atom, const Entry& entry) {
  has_hydrogens_ = has_hydrogens_ || atom.matches_hydrogen();
  patterns_.push_back({std::move(residue), std::move(atom), entry});
}

const RadiiTable::Entry* RadiiTable::find_named(const std::string& residue, const std::string& atom) const {
  const std::string canonical = canonical_residue(residue);
  const std::string canonical_name = canonical_atom(canonical, atom);
  // AMBER names the residues at the ends of a chain NALA and CALA.
  for (const std::string& name : {key(residue, atom), key(canonical, canonical_name), key("*", atom),
                                  key("*", canonical_name), key('N' + canonical, atom), key('C' + canonical, atom)}) {
    const auto found = names_.find(name);
    if (found != names_.end()) return &found->second;
  }
  return nullptr;
}

std::optional<FoundRadius> RadiiTable::find(const Atom& atom, bool hydrogens_used) const {
  const Entry* entry = find_named(atom.residue_name, atom.name);
  if (!entry && is_hydrogen_name(atom.name) && std::isdigit(static_cast<unsigned char>(atom.name.back()))) {
    std::string other = atom.name;
    for (const char digit : {'1', '2', '3'}) {
      other.back() = digit;
      if (!entry) entry = find_named(atom.residue_name, other);
    }
  }
  for (const Rule& rule : patterns_) {
    if (entry) break;
    if (rule.residue.matches(atom.residue_name) && rule.atom.matches(atom.name)) entry = &rule.entry;
  }
  if (!entry) return std::nullopt;
  return FoundRadius{hydrogens_used ? entry->with_hydrogens : entry->united, entry->label, source_};
}

}  // namespace meniscus
