// SPDX-License-Identifier: BSD-3-Clause
// Bonds of a molecule: listed by its file, from templates of standard residues, or guessed by distance; hydrogen bonds
// between two sets of atoms; and the periodic box, across which bonds may lead.
#pragma once

#include "core/structure/structure.h"

namespace meniscus {

/// The periodic box of a simulation, of any shape.
class PeriodicCell {
 public:
  /// Makes the box of vectors a, b, c in the columns, in Å. Returns nothing for a box without volume, which files have
  /// where there is no box, and for edges that are not 1e-6 to 1e9 Å long.
  static std::optional<PeriodicCell> of(const glm::dmat3& vectors);

  /// Returns the shortest of all vectors d + n_a a + n_b b + n_c c with integers n. It is exact for every shape of box.
  glm::dvec3 shortest(glm::dvec3 d) const;

 private:
  explicit PeriodicCell(const glm::dmat3& reduced);

  glm::dmat3 vectors_, inverse_;  ///< Minkowski-reduced, and the inverse
  /// Square of half the shortest lattice vector; a vector of this length has no shorter image.
  double half_shortest_squared_;
};

/// Returns the bonds of amino acids, nucleotides and water by the names of their heavy atoms. A hydrogen, or a site
/// without element, is bonded to the nearest heavy atom of its residue within 1.6 Å. Residues of a chain are bonded by
/// C-N and O3'-P within 2.2 Å. Disulphides are left out, because chains are connected without them. positions: Å, one
/// for each atom. cell: if given, distances are to the nearest image.
std::vector<Bond> template_bonds(std::span<const Atom> atoms, std::span<const glm::dvec3> positions,
                                 const std::optional<PeriodicCell>& cell);

/// Returns the bonds between atoms of one residue, and of neighbouring residues in a chain. Two atoms are bonded if
/// their distance is at most the sum of their covalent radii (B. Cordero et al., Dalton Trans. 2008, 2832) and 0.4 Å.
/// Other arguments are those of template_bonds.
std::vector<Bond> guessed_bonds(std::span<const Atom> atoms, std::span<const glm::dvec3> positions,
                                const std::optional<PeriodicCell>& cell);

/// Returns the bonds between these atoms as places in `atoms`, the lower place first, each once and in ascending order.
/// They are the bonds of `listed` (by Atom::index, in an assembly for each copy), the bonds of template_bonds(), and
/// bonds by distance for atoms that are in no standard residue.
/// An atom is bonded by distance if the distance is at most the sum of the covalent radii (B. Cordero et al., Dalton
/// Trans. 2008, 2832) and 0.4 Å, or 0.2 Å between standard residues, as in disulphides and cross-links. No bonds by
/// distance are made between two hydrogens, to a free ion or an atom of unknown element, or within 0.5 Å, because such
/// atoms are duplicates.
/// There are no bonds between models, copies or alternate locations: two atoms with different letters are not bonded if
/// the residue of either has an atom in several locations. Bonds longer than kLongestBond are left out, because they
/// cross a periodic box. fully_bonded: models (Atom::model) whose only bonds are those listed. Time is O(n) for
/// molecules.
std::vector<Bond> molecule_bonds(std::span<const Atom> atoms, std::span<const Bond> listed,
                                 std::span<const std::int32_t> fully_bonded = {});

/// Returns molecule_bonds() of atoms that are not in the order of their file.
std::vector<Bond> bonds_in_any_order(std::span<const Atom> atoms, std::span<const Bond> listed = {},
                                     std::span<const std::int32_t> fully_bonded = {});

inline constexpr double kLongestBond = 4.0;  ///< Å; bonds of caesium to ligands are 3.3 Å long

/// Returns the hydrogen bonds D-H...A between two sets of atoms, as pairs of donor D and acceptor A in ascending order.
/// Each pair is there once; both may be in either set. one, other: one truth value for each atom.
///
/// D is N, O or S with a hydrogen, and A is O, or N with a free electron pair. Where a residue has hydrogens, H...A is
/// at most 2.5 Å and D-H...A more than 120 degrees (E. N. Baker and R. E. Hubbard, Prog. Biophys. Mol. Biol. 44, 97
/// (1984)). Where it has none, planar nitrogens with two neighbours, as in peptides, get a hydrogen 1.01 Å opposite of
/// them. For other donors D...A is at most 3.5 Å, and the angles at D and A to each of their neighbours are more than
/// 90 degrees (I. K. McDonald and J. M. Thornton, J. Mol. Biol. 238, 777 (1994)). These donors are water, OH (C-O is
/// longer than 1.30 Å), and N except for nitriles, planar N with three neighbours, and N1, N3 and N7 of bases without
/// hydrogen. N with two neighbours that is neither in an amide nor in a base may be both, as in histidine.
///
/// There are no bonds within a residue, across at most three covalent bonds, between alternate locations or models of
/// one file, and to periodic images. Time is O(n) for molecules.
std::vector<Bond> hydrogen_bonds(const Structure& structure, const std::vector<bool>& one,
                                 const std::vector<bool>& other);

/// Returns the two different atoms, one of each set, with the smallest distance; of equal ones the first in ascending
/// order; nothing if there are no such atoms. one, other: one truth value for each atom.
std::optional<Bond> closest_pair(std::span<const Atom> atoms, const std::vector<bool>& one,
                                 const std::vector<bool>& other);

}  // namespace meniscus
