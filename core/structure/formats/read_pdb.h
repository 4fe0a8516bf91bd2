// SPDX-License-Identifier: BSD-3-Clause
// Reads PDB and what has its records with other columns behind the B-factor.
#pragma once

#include <cstddef>
#include <string_view>

#include "core/structure/formats/structure_formats.h"

namespace meniscus {

/// Takes charge and element of an atom of a format from the columns behind the B-factor; false where they name an
/// element that nobody knows. Throws InputError.
using ColumnsBehind = bool (*)(const TextFile& file, std::size_t line_number, std::string_view line, Atom& atom);

/// behind: null for PDB, which has segment and element there.
FileContents read_pdb(const TextFile& file, const ModelChoice& models, ColumnsBehind behind);

}  // namespace meniscus
