// SPDX-License-Identifier: BSD-3-Clause
// How the heavy atoms of standard residues are bonded, on which united-atom radii depend.
#pragma once

#include <string>
#include <string_view>

namespace meniscus {

/// The class of an atom of an amino acid, nucleotide or water, in the notation of J. Tsai et al., J. Mol. Biol. 290,
/// 253 (1999): element, bonded atoms, hydrogens among them. "C4H2" is a tetrahedral carbon with two hydrogens. Charge
/// states are those of the wwPDB's chemical components (acids are protonated). Empty: not known. Other names of the
/// same residues and atoms (canonical_names.h) are understood.
std::string_view bonding_class(const std::string& residue_name, const std::string& atom_name);

}  // namespace meniscus
