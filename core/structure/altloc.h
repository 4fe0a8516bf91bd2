// SPDX-License-Identifier: BSD-3-Clause
// Which alternate location of a residue is kept.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace meniscus {

struct Atom;

/// One letter a residue is kept, and the atoms without a letter.
struct AltlocChoice {
  enum class Rule {
    best,    ///< highest mean occupancy, then lowest mean B-factor, then first letter
    first,   ///< the one the file gives first
    letter,  ///< `letter`, and in residues without it the best
    all      ///< every one of them; they overlap
  };
  Rule rule = Rule::best;
  char letter = ' ';
};

/// Reads "best", "first", "all" or a single letter or digit; nothing for any other text.
std::optional<AltlocChoice> parse_altloc_choice(std::string_view text);

/// The letter to keep by residue (Atom::residue), blank for residues without alternatives. Not for Rule::all.
std::vector<char> kept_altlocs(const std::vector<Atom>& atoms, const AltlocChoice& choice);

}  // namespace meniscus
