// SPDX-License-Identifier: BSD-3-Clause
// CIF documents, parsed by gemmi from text or from BinaryCIF.
#pragma once

#include <functional>

#include <gemmi/cifdoc.hpp>

#include "core/base/text_file.h"

namespace meniscus {

/// True if the first bytes are a map of MessagePack whose first key is one of BinaryCIF.
bool is_binary_cif(std::string_view bytes);

/// A function that receives some thousand rows of _atom_site, which the block has during the call. first: number of
/// rows before these. Tables that follow in the file are not in the block yet.
using TakeAtomRows = std::function<void(gemmi::cif::Block& block, std::size_t first)>;

/// Parses the whole file once; read_binary_cif() reads BinaryCIF. Rows of _atom_site are passed to `take` while they
/// are read and are not kept, because all rows as text take three times the memory of all atoms. The table without rows
/// stays in the document. Throws InputError with the line of a syntax error, and the exceptions of `take`.
gemmi::cif::Document parse_cif(const TextFile& file, const TakeAtomRows& take);

/// Returns the tables of atoms, entities, secondary structure and assemblies, in the form of parse_cif. Throws
/// InputError if the bytes (TextFile::text) are not BinaryCIF, if they unpack to far more than a molecule of their
/// size, or if this build cannot read BinaryCIF.
gemmi::cif::Document read_binary_cif(const TextFile& file);

}  // namespace meniscus
