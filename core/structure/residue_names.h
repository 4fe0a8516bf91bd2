// SPDX-License-Identifier: BSD-3-Clause
// What names of residues and atoms mean: their class, their canonical spelling, and the bonds of their heavy
// atoms.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace meniscus {

/// Amino acids of the wwPDB's chemical components (modified ones too), and caps of chains (ACE, NME, NH2, ...).
bool is_amino_acid_name(const std::string& residue_name);

/// Caps of peptide chains: ACE, NME, NH2, ...
bool is_chain_cap_name(const std::string& residue_name);

/// Nucleotides of the wwPDB's chemical components, and the common names of force fields (ADE, DA5, RA3, ...).
bool is_nucleotide_name(const std::string& residue_name);

/// Water by the names of the wwPDB and of molecular dynamics programs.
bool is_water_name(const std::string& residue_name);

/// "HSD", "HIE" -> "HIS"; "CYX" -> "CYS"; "ADE", "RA5" -> "A"; "DA3" -> "DA"; any water -> "HOH"; others as they are.
std::string canonical_residue(const std::string& residue_name);

/// "O1P" -> "OP1", "C5*" -> "C5'", "HN" -> "H", "OT2" -> "OXT"; of ILE also "CD" -> "CD1"; of amino acids "O1",
/// "OC1" -> "O" and "O2", "OC2" -> "OXT", the ends of chains by GROMACS; others as they are. The residue is given by
/// its canonical name.
std::string canonical_atom(std::string_view residue, const std::string& atom_name);

/// The class of an atom of an amino acid, nucleotide or water, in the notation of J. Tsai et al., J. Mol. Biol. 290,
/// 253 (1999): element, bonded atoms, hydrogens among them. "C4H2" is a tetrahedral carbon with two hydrogens. Charge
/// states are those of the wwPDB's chemical components (acids are protonated). Empty: not known. Other names of the
/// same residues and atoms are understood.
std::string_view bonding_class(const std::string& residue_name, const std::string& atom_name);

/// How many atoms of the residue have a class, OXT included; 0: the residue is not known.
std::size_t heavy_atoms_of(const std::string& residue_name);

}  // namespace meniscus
