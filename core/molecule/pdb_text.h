// SPDX-License-Identifier: BSD-3-Clause
// Checks the columns of PDB text strictly and rewrites the atom records so that a lenient parser reads them right.
#pragma once

#include <string>
#include <vector>

#include "core/molecule/text_file.h"

namespace meniscus {

/// True if the text has a line with a PDB record name.
bool looks_like_pdb(std::string_view text);

/// The first model as PDB text of nothing but well-formed ATOM, HETATM and TER records.
/// Missing or unreadable occupancies stand as 1.00 and B-factors as nan; serial numbers and charges are blank.
struct CheckedPdb {
  std::string text;
  std::size_t models = 0;
  std::size_t other_model_atoms = 0;  ///< counted, not checked
  std::vector<std::string> warnings;
};

/// Throws InputError with the line: coordinates that are no finite numbers, atom records cut short, no atoms at all.
CheckedPdb check_pdb(const TextFile& file);

}  // namespace meniscus
