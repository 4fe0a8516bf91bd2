// SPDX-License-Identifier: BSD-3-Clause
// The residues of a file, even where numbers wrap and repeat: their numbers, the alternates that are kept, the links of
// chains.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/structure/structure.h"

namespace meniscus {

struct Atom;

/// Numbers residues in the order of the file. Neighbouring atoms of one model, chain, segment, number, insertion code
/// and name are one residue (of several names only where all are alternate locations). Where such a combination comes
/// again later it is the same residue too, unless it brings an atom that the residue has already: then its number has
/// wrapped (after 9,999 in PDB and 99,999 in GRO), and it is another one.
class ResidueCounter {
 public:
  /// `atoms` are those counted so far; the caller appends each atom after it was numbered.
  explicit ResidueCounter(const std::vector<Atom>& atoms) : atoms_(atoms) {}

  /// Sets atom.index and atom.residue.
  void number(Atom& atom);
  /// The next atom begins a new piece, as after TER.
  void end_piece() { piece_open_ = false; }

 private:
  struct Piece {
    std::uint32_t residue;
    std::size_t begin, end;  ///< atoms
  };
  bool continues(const Piece& piece, const Atom& atom) const;

  const std::vector<Atom>& atoms_;
  std::unordered_map<std::string, Piece> last_piece_;
  Piece* piece_ = nullptr;
  bool piece_open_ = false;
  std::uint32_t residues_ = 0;
};

/// One letter a residue is kept, the atoms without a letter, and what these lack.
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

/// Whether each atom is kept. A residue (Atom::residue) is completed: atoms whose names the kept ones lack come from
/// its other alternate locations, that of the highest mean occupancy first, then in the order of the file. Residues of
/// other names at the same place give none, and hydrogens come with the atom that they are bonded to. A warning lists
/// what was mixed.
std::vector<bool> kept_alternates(const std::vector<Atom>& atoms, const AltlocChoice& choice,
                                  std::vector<Warning>& warnings);

/// For each residue (Atom::residue): does a peptide bond, C to N of two residues with CA or caps of chains, or a
/// phosphodiester, O3' to P of two residues with C4', join it to another residue of its model? By distance, 1.0 to
/// 2.2 Å (bonds are 1.33 and 1.6 Å long, strangers never nearer than 2.5 Å), or by `bonds`, for topologies without
/// coordinates; atoms at the origin count as such. O(n) for molecules.
std::vector<bool> linked_residues(std::span<const Atom> atoms, std::span<const Bond> bonds);

/// For each atom the accessible area of its residue over greatest_accessible_area(). areas: Å², the accessible area of
/// each atom by a probe of kAccessibilityProbe. NaN: no greatest area is known, or a heavy atom of the residue is
/// missing, so that its area would be that of a part.
std::vector<double> relative_accessibility(const Structure& structure, std::span<const double> areas);

}  // namespace meniscus
