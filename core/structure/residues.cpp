// SPDX-License-Identifier: BSD-3-Clause
// Tells where a residue ends, and chooses among its alternate locations.
#include "core/structure/residues.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "core/structure/structure.h"

namespace meniscus {
namespace {

bool same_place(const Atom& a, const Atom& b) {
  return a.residue_number == b.residue_number && a.insertion_code == b.insertion_code && a.model == b.model &&
         a.chain == b.chain && a.subchain == b.subchain && a.segment == b.segment;
}

/// Residues of several names at one place are alternatives (microheterogeneity) if both bear a letter.
bool same_or_alternative_name(const Atom& a, const Atom& b) {
  return a.residue_name == b.residue_name || (a.altloc != ' ' && b.altloc != ' ');
}

std::string key_of(const Atom& atom) {
  return fmt::format("{}\n{}\n{}\n{}\n{}\n{}", atom.model, atom.chain, atom.subchain, atom.segment, atom.residue_number,
                     atom.insertion_code);
}

}  // namespace

bool ResidueCounter::continues(const Piece& piece, const Atom& atom) const {
  const auto begin = atoms_.begin() + static_cast<std::ptrdiff_t>(piece.begin);
  const auto end = atoms_.begin() + static_cast<std::ptrdiff_t>(piece.end);
  return same_or_alternative_name(atoms_[piece.begin], atom) && std::none_of(begin, end, [&](const Atom& other) {
           return other.name == atom.name && other.altloc == atom.altloc && other.residue_name == atom.residue_name;
         });
}

void ResidueCounter::number(Atom& atom) {
  atom.index = static_cast<std::uint32_t>(atoms_.size());
  if (!piece_open_ || !same_place(atoms_.back(), atom) || !same_or_alternative_name(atoms_.back(), atom)) {
    const auto [found, added] = last_piece_.try_emplace(key_of(atom), Piece{residues_, atoms_.size(), atoms_.size()});
    piece_ = &found->second;
    if (added || !continues(*piece_, atom)) {
      *piece_ = {residues_++, atoms_.size(), atoms_.size()};
    } else {
      piece_->begin = atoms_.size();
    }
    piece_open_ = true;
  }
  piece_->end = atoms_.size() + 1;
  atom.residue = piece_->residue;
}

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
