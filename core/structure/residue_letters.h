// SPDX-License-Identifier: BSD-3-Clause
// One-letter codes of residues, as sequences are written with.
#pragma once

#include <string>

namespace meniscus {

/// Returns the letter of an amino acid or nucleotide, such as 'M' for MET and for the modified MSE. Returns 'X' for a
/// residue that has none.
char residue_letter(const std::string& residue_name);

}  // namespace meniscus
