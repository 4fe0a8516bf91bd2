// SPDX-License-Identifier: BSD-3-Clause
// Tells polymer, ligand, water and ion apart, and finds elements that a file does not state, alike for every format.
#pragma once

#include <cstdint>
#include <span>
#include <string>
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
      0;  ///< what the columns of the name suggest (PDB: " CA " is carbon, "CA  " calcium); 0: nothing
};

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
/// are warned about. `hints` has one entry an atom, or none; `bonds` are those of a file without coordinates.
void classify_atoms(std::vector<Atom>& atoms, std::vector<Warning>& warnings, std::span<const AtomHints> hints = {},
                    std::span<const Bond> bonds = {});

/// The atomic number by the mass (atomic mass units, within 0.1), which tells calcium from carbon, unless the name says
/// another element of organic residues: where mass was moved from carbon and nitrogen to their hydrogens, NH weighs as
/// much as C. 0: the mass does not decide.
std::uint8_t element_of_mass(const std::string& name, double mass);

}  // namespace meniscus
