// SPDX-License-Identifier: BSD-3-Clause
// The residues of a file, even where numbers wrap and repeat: their numbering, the choice of alternate locations, links
// between residues, their accessibility, and the molecules that do not belong to polymers.
#pragma once

#include <string_view>
#include <unordered_map>

#include "core/structure/structure.h"

namespace meniscus {

/// Numbers residues in the order of the file. Consecutive atoms with the same model, chain, segment, number, insertion
/// code and name form one residue. It may have several names only if all its atoms are alternate locations. Atoms with
/// the same identifiers later in the file belong to the same residue, unless it has such an atom already. In that case
/// the number has wrapped (after 9,999 in PDB and 99,999 in GRO), and they form a new residue.
class ResidueCounter {
 public:
  /// Begins with no residues. `atoms` are those numbered so far; the caller appends each atom after it was numbered.
  /// `atoms` must outlive this object.
  explicit ResidueCounter(const std::vector<Atom>& atoms) : atoms_(atoms) {}

  /// Sets atom.index and atom.residue.
  void number(Atom& atom);
  /// Makes the next atom begin a new piece, as after TER.
  void end_piece() { is_piece_open_ = false; }

 private:
  struct Piece {
    std::uint32_t residue;
    std::size_t begin, end;  ///< range of atoms
  };
  bool continues(const Piece& piece, const Atom& atom) const;

  const std::vector<Atom>& atoms_;
  std::unordered_map<std::string, Piece> last_piece_;
  Piece* piece_ = nullptr;
  bool is_piece_open_ = false;
  std::uint32_t residues_ = 0;
};

/// The choice of alternate locations. One letter is kept in each residue, together with the atoms without a letter, and
/// with atoms of other letters that these lack.
struct AltlocChoice {
  enum class Rule {
    best,    ///< highest mean occupancy, then lowest mean B-factor, then first letter
    first,   ///< letter that comes first in the file
    letter,  ///< `letter`, or the best one in residues without it
    all      ///< all letters, whose atoms overlap
  };
  Rule rule = Rule::best;
  char letter = ' ';
};

/// Parses "best", "first", "all" or a single letter or digit. Returns nothing for any other text.
std::optional<AltlocChoice> parse_altloc_choice(std::string_view text);

/// Returns for each atom whether it is kept. Residues (Atom::residue) are completed: atoms with names that the kept
/// ones lack are taken from the other alternate locations, in descending order of mean occupancy and then in the order
/// of the file. Residues with other names at the same place are not used, and hydrogens are taken together with the
/// atom that they are bonded to. A warning lists the completed residues.
std::vector<bool> kept_alternates(const std::vector<Atom>& atoms, const AltlocChoice& choice,
                                  std::vector<Warning>& warnings);

/// Returns for each residue (Atom::residue) whether a peptide bond or a phosphodiester links it to another residue of
/// its model. A peptide bond joins C and N of two residues with CA or of caps of chains; a phosphodiester joins O3' and
/// P of two residues with C4'. Bonds are found by distance, 1.0 to 2.2 Å (they are 1.33 and 1.6 Å long, and atoms that
/// are not bonded are never nearer than 2.5 Å). Topologies without coordinates, in which all atoms are at the origin,
/// have them in `bonds`. Time is O(n) for molecules.
std::vector<bool> linked_residues(std::span<const Atom> atoms, std::span<const Bond> bonds);

/// Returns for each atom the accessible area of its residue divided by greatest_accessible_area(). areas: accessible
/// area of each atom in Å², by a probe of kAccessibilityProbe. Returns NaN if no greatest area is known, or if a heavy
/// atom of the residue is missing, because the area would be that of a part.
std::vector<double> relative_accessibility(const Structure& structure, std::span<const double> areas);

/// The molecules of a file outside of its polymers. Both lists have one entry per atom. They are empty if the file has
/// no polymer, because such a file is taken whole.
struct OutsidePolymer {
  /// The classes of molecules. `inside`: polymers and everything that is bound to them, water and ions.
  enum class Part : std::uint8_t { inside, ligand, lipid };

  std::vector<Part> part;
  /// True for atoms of ligands, lipids and ions that pictures draw next to a surface of the polymer. Molecules of one
  /// name are not drawn if a model has more than 20 of them, because they are solvent, salt or a membrane; all lipids
  /// count as one name. Ligands of at least 40 heavy atoms are always drawn. Ions are not drawn in a box of water,
  /// which has more than 10 water molecules per residue.
  std::vector<bool> drawn;
};

/// Returns the molecules outside of the polymers. Sugars are inside if they are bound to a polymer, directly or by
/// other sugars. atoms: as the readers return them, with residues in the order of the file. bonds: the bonds of the
/// file, by Atom::index; bonds by distance are added as in molecule_bonds(). Time is linear in the number of atoms.
OutsidePolymer outside_polymer(std::span<const Atom> atoms, std::span<const Bond> bonds);

/// True if there is nothing but ions and water, so that the ions are what the file is about, such as a slab of metal.
bool has_only_ions(std::span<const Atom> atoms);

}  // namespace meniscus
