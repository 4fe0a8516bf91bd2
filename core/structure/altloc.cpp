// SPDX-License-Identifier: BSD-3-Clause
// Compares the alternate locations of each residue by their means.
#include "core/structure/altloc.h"
#include "core/structure/structure.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <tuple>

namespace meniscus {
namespace {

/// The atoms of one alternate location in one residue.
struct Conformer {
  char letter;
  double occupancy = 0.0, b_factor = 0.0;  ///< sums; missing ones count as 1 and 0
  int atoms = 0;

  auto rank() const { return std::make_tuple(-occupancy / atoms, b_factor / atoms, letter); }
};

char chosen(const std::vector<Conformer>& conformers, const AltlocChoice& choice) {
  if (choice.rule == AltlocChoice::Rule::first) return conformers.front().letter;
  const bool there = std::any_of(conformers.begin(), conformers.end(),
                                 [&](const Conformer& conformer) { return conformer.letter == choice.letter; });
  if (choice.rule == AltlocChoice::Rule::letter && there) return choice.letter;
  return std::min_element(conformers.begin(), conformers.end(),
                          [](const Conformer& a, const Conformer& b) { return a.rank() < b.rank(); })
      ->letter;
}

}  // namespace

std::optional<AltlocChoice> parse_altloc_choice(std::string_view text) {
  if (text == "best") return AltlocChoice{AltlocChoice::Rule::best};
  if (text == "first") return AltlocChoice{AltlocChoice::Rule::first};
  if (text == "all") return AltlocChoice{AltlocChoice::Rule::all};
  if (text.size() == 1 && std::isalnum(static_cast<unsigned char>(text[0])))
    return AltlocChoice{AltlocChoice::Rule::letter, text[0]};
  return std::nullopt;
}

std::vector<char> kept_altlocs(const std::vector<Atom>& atoms, const AltlocChoice& choice) {
  std::uint32_t residues = 0;
  std::map<std::uint32_t, std::vector<Conformer>> conformers;
  for (const Atom& atom : atoms) {
    residues = std::max(residues, atom.residue + 1);
    if (atom.altloc == ' ') continue;
    std::vector<Conformer>& of_residue = conformers[atom.residue];
    auto found = std::find_if(of_residue.begin(), of_residue.end(),
                              [&](const Conformer& conformer) { return conformer.letter == atom.altloc; });
    if (found == of_residue.end()) found = of_residue.insert(found, Conformer{atom.altloc});
    found->occupancy += std::isnan(atom.occupancy) ? 1.0 : atom.occupancy;
    found->b_factor += std::isnan(atom.b_factor) ? 0.0 : atom.b_factor;
    ++found->atoms;
  }
  std::vector<char> kept(residues, ' ');
  for (const auto& [residue, of_residue] : conformers) kept[residue] = chosen(of_residue, choice);
  return kept;
}

}  // namespace meniscus
