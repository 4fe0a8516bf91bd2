// SPDX-License-Identifier: BSD-3-Clause
// Numbers that atoms can be coloured by: from a file of the user's own, and the hydrophobicity of residues.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// A file with one number an atom.
struct NumberFile {
  std::string path;
  std::vector<double> numbers;  ///< NaN: missing
};

/// Reads numbers between blanks, commas and line ends; nan, ? and - stand for a missing one, # begins a comment.
/// Throws InputError naming the line of the first word that is none of these; see also read_text_file.
NumberFile read_number_file(const std::string& path);

/// Hydropathy of an amino acid, -4.5 (arginine) to 4.5 (isoleucine): J. Kyte and R. F. Doolittle, J. Mol. Biol. 157,
/// 105 (1982), table 2. Force-field names of charge states and selenomethionine go with their parent; NaN for all
/// others.
double hydropathy(std::string_view residue_name);

}  // namespace meniscus
