// SPDX-License-Identifier: BSD-3-Clause
// Numbers that atoms can be coloured by: from a file of the user's own, and the hydrophobicity of residues.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// A residue as files of numbers name it.
struct ResidueName {
  std::string chain;
  std::int32_t number = 0;
  char insertion_code = ' ';
  auto operator<=>(const ResidueName&) const = default;
};

/// A file of numbers: one an atom in order, or by atom, or by residue; only one of the three is filled. NaN: missing.
struct NumberFile {
  std::string path;
  std::vector<double> numbers{};              ///< in the order of atoms
  std::map<std::uint32_t, double> by_atom{};  ///< by place in the molecule's file, from 0
  std::map<ResidueName, double> by_residue{};
  std::string column{};  ///< whose numbers these are; empty if columns have no names

  bool empty() const { return numbers.empty() && by_atom.empty() && by_residue.empty(); }
};

/// Reads one of three layouts; nan, ? and - stand for a missing number, # begins a comment:
/// - numbers between blanks, commas and line ends, one an atom;
/// - lines "chain number value" (the number of the residue with its insertion code, as in 52A), where the first chain
/// is
///   no number or the line "chain number value" or "chain resid value" stands before;
/// - CSV with a header, as `meniscus surface --csv` and `--csv-residues` write it: by its column "index", else by
///   "chain", "number" (or "resid") and, if there, "icode". `column` names the one of the numbers; it may be left out
///   where there is one beside these.
/// Throws InputError naming the line, the word and what is wanted; see also read_text_file.
NumberFile read_number_file(const std::string& path, const std::string& column = {});

/// Hydropathy of an amino acid, -4.5 (arginine) to 4.5 (isoleucine): J. Kyte and R. F. Doolittle, J. Mol. Biol. 157,
/// 105 (1982), table 2. Force-field names of charge states and selenomethionine go with their parent; NaN for all
/// others.
double hydropathy(std::string_view residue_name);

}  // namespace meniscus
