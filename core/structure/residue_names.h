// SPDX-License-Identifier: BSD-3-Clause
// Which residue names are amino acids, their caps, nucleotides or water.
#pragma once

#include <string>

namespace meniscus {

/// Amino acids of the wwPDB's chemical components (modified ones too), and caps of chains (ACE, NME, NH2, ...).
bool is_amino_acid_name(const std::string& residue_name);

/// Caps of peptide chains: ACE, NME, NH2, ...
bool is_chain_cap_name(const std::string& residue_name);

/// Nucleotides of the wwPDB's chemical components, and the common names of force fields (ADE, DA5, RA3, ...).
bool is_nucleotide_name(const std::string& residue_name);

/// Water by the names of the wwPDB and of molecular dynamics programs.
bool is_water_name(const std::string& residue_name);

}  // namespace meniscus
