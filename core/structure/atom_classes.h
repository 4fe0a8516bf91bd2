// SPDX-License-Identifier: BSD-3-Clause
// Classifies residues as polymer, ligand, water or ion, and finds elements that a file does not have, in the same way
// for all formats.
#pragma once

#include <string_view>

#include "core/structure/structure.h"

namespace meniscus {

/// The class of an atom's residue according to the file itself.
enum class ResidueStatement : std::uint8_t { none, polymer, other };

/// Information that a file has about an atom, in addition to its names.
struct AtomHints {
  ResidueStatement residue = ResidueStatement::none;
  bool is_heteroatom = false;  ///< true for HETATM: not in a standard residue of a chain, but perhaps in a modified one
  /// The element by the columns of the name (PDB: " CA " is carbon, "CA  " calcium); 0: none.
  std::uint8_t element = 0;
  bool is_site = false;  ///< true for a virtual site or Drude particle, by its type, element column or mass
  float mass = std::numeric_limits<float>::quiet_NaN();  ///< atomic mass units; NaN: not in the file
};

/// True for the symbols of particles that are not atoms: EP (OpenMM, ParmEd), LP, VS (MDTraj).
bool is_site_symbol(std::string_view symbol);

/// True for residues and ligands that are common enough to be in gemmi's table.
bool is_tabulated_residue(const std::string& residue_name);

/// Sets `kind` of all atoms, residue by residue. The statement of the file decides first, then the name. Amino acids
/// and nucleotides of the wwPDB's chemical components and of force fields are polymer, unless they are heteroatoms or
/// bare bases. Such residues, and residues of any other name, are polymer if they are linked to another residue
/// (residues.h). Heteroatoms with the name of an amino acid or nucleotide are polymer, too, where a chain has one atom
/// per residue, or where the residues on both sides are missing. All other residues are ligands: free amino acids and
/// nucleotides, cofactors, sugars.
///
/// In a file that has residues of Martini's beads (martini.h), all residues consist of beads, except for water and
/// polymers of atoms. Beads have no element.
///
/// Sets `element` where it is 0 or cannot be right. Names are ambiguous (CA is carbon or calcium, HG hydrogen or
/// mercury), but amino acids and nucleotides contain only H, C, N, O, S, P and Se. A warning is added for elements of
/// the file that cannot be right. A name never gives an element that the mass excludes. `hints` has one entry per atom,
/// or none; `bonds` are those of a file without coordinates.
///
/// Returns for each atom whether it is a virtual site or a Drude particle. That follows from its hint, or from its name
/// and place: a D next to the atom that it belongs to, OM in water, the dummy masses MCB1 and MCB2 of GROMACS.
[[nodiscard]] std::vector<bool> classify_atoms(std::vector<Atom>& atoms, std::vector<Warning>& warnings,
                                               std::span<const AtomHints> hints = {}, std::span<const Bond> bonds = {});

/// Sets `element`, where it is 0, by the masses in the hints, within 0.1 atomic mass units. Masses distinguish calcium
/// from carbon. The name decides if it gives another element of organic residues, because where mass was moved from
/// carbon and nitrogen to their hydrogens, NH weighs as much as C. Particles lighter than any atom are marked as sites.
/// The mass of a Drude particle is added to the atom before it. If no mass of the file is that of an atom, masses are
/// ignored.
void set_elements_by_mass(std::vector<Atom>& atoms, std::span<AtomHints> hints);

}  // namespace meniscus
