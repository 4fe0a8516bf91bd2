// SPDX-License-Identifier: BSD-3-Clause
// Reads PDB, and formats that have the same records with other columns after the B-factor.
#pragma once

#include <cstddef>
#include <string_view>

#include "core/structure/formats/structure_formats.h"

namespace meniscus {

/// A function that takes charge and element of an atom from the columns after the B-factor. False if the element is
/// unknown. Throws InputError.
using TrailingColumns = bool (*)(const TextFile& file, std::size_t line_number, std::string_view line, Atom& atom);

/// Reads a file. read_trailing: null for PDB, which has segment and element in these columns.
FileContents read_pdb(const TextFile& file, const ModelChoice& models, TrailingColumns read_trailing);

}  // namespace meniscus
