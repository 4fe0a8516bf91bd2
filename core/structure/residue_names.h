// SPDX-License-Identifier: BSD-3-Clause
// Names of residues and atoms: their class, their canonical spelling, their letters, the bonds of their heavy atoms,
// and which residues are lipids.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace meniscus {

/// True for amino acids of the wwPDB's chemical components, including modified ones, and for caps of chains (ACE, NME,
/// NH2, ...).
bool is_amino_acid_name(const std::string& residue_name);

/// True for caps of peptide chains: ACE, NME, NH2, ...
bool is_chain_cap_name(const std::string& residue_name);

/// True for nucleotides of the wwPDB's chemical components, and for common names of force fields (ADE, DA5, RA3, ...).
bool is_nucleotide_name(const std::string& residue_name);

/// True for water by the names of the wwPDB and of molecular dynamics programs.
bool is_water_name(const std::string& residue_name);

/// Returns the name of the same residue in the wwPDB: "HSD", "HIE" -> "HIS"; "CYX" -> "CYS"; "ADE", "RA5" -> "A"; "DA3"
/// -> "DA"; any water -> "HOH". Other names are unchanged.
std::string canonical_residue(const std::string& residue_name);

/// Returns the name of the same atom in the wwPDB: "O1P" -> "OP1", "C5*" -> "C5'", "HN" -> "H", "OT2" -> "OXT"; in ILE
/// also "CD" -> "CD1"; in amino acids "O1", "OC1" -> "O" and "O2", "OC2" -> "OXT", which are the ends of chains in
/// GROMACS. Other names are unchanged. residue: the canonical name.
std::string canonical_atom(std::string_view residue, const std::string& atom_name);

/// Returns the class of an atom of an amino acid, nucleotide or water in the notation of J. Tsai et al., J. Mol. Biol.
/// 290, 253 (1999): element, number of bonded atoms, number of hydrogens among them. "C4H2" is a tetrahedral carbon
/// with two hydrogens. Charge states are those of the wwPDB's chemical components, where acids are protonated. Other
/// names of the same residues and atoms are understood. The result is empty if the atom is not known.
std::string_view bonding_class(const std::string& residue_name, const std::string& atom_name);

/// Returns how many atoms of the residue have a class, including OXT. Returns 0 if the residue is not known.
std::size_t heavy_atoms_of(const std::string& residue_name);

struct Atom;

/// True if the residue is a lipid, a fatty acid or a sterol. Names are those of the wwPDB's chemical components and of
/// CHARMM, AMBER Lipid21 (where heads and tails are residues), GROMOS and Martini. Most of these have two letters for
/// the tails and two for the head, as in POPC. Polymers, water, ions and detergents are not lipids.
bool is_lipid(std::span<const Atom> residue);

/// Returns the letter of an amino acid or nucleotide, such as 'M' for MET and for the modified MSE. Returns 'X' for a
/// residue that has none.
char residue_letter(const std::string& residue_name);

}  // namespace meniscus
