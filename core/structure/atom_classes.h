// SPDX-License-Identifier: BSD-3-Clause
// Tells polymer, ligand, water and ion apart, and finds elements that a file does not state, alike for every format.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/structure/structure.h"

namespace meniscus {

/// What a file itself says about the residue of an atom.
enum class ResidueStatement : std::uint8_t { none, polymer, other };

/// What a file says about an atom besides its names.
struct AtomHints {
  ResidueStatement residue = ResidueStatement::none;
  bool heteroatom = false;  ///< HETATM: no standard residue of a chain, but perhaps a modified one
  std::uint8_t element =
      0;              ///< what the columns of the name suggest (PDB: " CA " is carbon, "CA  " calcium); 0: nothing
  bool site = false;  ///< a virtual site or Drude particle by its type, its element column or its mass
  float mass = std::numeric_limits<float>::quiet_NaN();  ///< atomic mass units; NaN: the file gives none
};

/// True for the symbols by which programs mark particles that are not atoms: EP (OpenMM, ParmEd), LP, VS (MDTraj).
bool is_site_symbol(std::string_view symbol);

/// True for the residues and ligands common enough to be in gemmi's table.
bool is_tabulated_residue(const std::string& residue_name);

/// Sets `kind` of all atoms, residue by residue. What the file states decides; then names: amino acids and nucleotides
/// of the wwPDB's chemical components and of force fields are polymer unless they are heteroatoms or bare bases. Those,
/// and residues of any other name, are polymer if they are linked to another residue (residues.h); heteroatoms with
/// the name of an amino acid or nucleotide also where a chain is drawn by one atom a residue, or is missing on both
/// their sides. All else is a ligand: free amino acids and nucleotides, cofactors, sugars.
///
/// In a file that has residues of Martini's beads (martini.h), all residues but water and polymers of atoms are such,
/// and have no element.
///
/// Sets `element` where it is 0 or cannot be right: names are ambiguous (CA is carbon or calcium, HG hydrogen or
/// mercury), but amino acids and nucleotides hold H, C, N, O, S, P and Se only; stated elements that cannot be right
/// are warned about. A name never gives an element that the mass excludes. `hints` has one entry an atom, or none;
/// `bonds` are those of a file without coordinates.
///
/// Returns for each atom whether it is a virtual site or a Drude particle: by its hint, or by its name and place (a D
/// beside the atom that it belongs to, OM in water, the dummy masses MCB1 and MCB2 of GROMACS).
[[nodiscard]] std::vector<bool> classify_atoms(std::vector<Atom>& atoms, std::vector<Warning>& warnings,
                                               std::span<const AtomHints> hints = {}, std::span<const Bond> bonds = {});

/// Sets `element`, where it is 0, by the masses in the hints (within 0.1), which tell calcium from carbon, unless the
/// name says another element of organic residues: where mass was moved from carbon and nitrogen to their hydrogens, NH
/// weighs as much as C. Marks particles lighter than any atom as sites, and gives the mass of a Drude particle back to
/// the atom before it. Masses of which none is that of an atom do not count.
void set_elements_by_mass(std::vector<Atom>& atoms, std::span<AtomHints> hints);

}  // namespace meniscus
