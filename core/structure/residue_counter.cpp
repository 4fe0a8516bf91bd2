// SPDX-License-Identifier: BSD-3-Clause
// Residues by their names and numbers, with a look back where those come again.
#include "core/structure/residue_counter.h"
#include "core/structure/structure.h"

#include <algorithm>

#include <fmt/format.h>

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

}  // namespace meniscus
