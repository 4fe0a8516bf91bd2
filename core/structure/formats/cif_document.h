// SPDX-License-Identifier: BSD-3-Clause
// Parses CIF with gemmi, or decodes BinaryCIF, at this one place.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include <gemmi/cifdoc.hpp>

#include "core/base/text_file.h"

namespace meniscus {

/// By the first bytes: a map of MessagePack whose first key is one of BinaryCIF's.
bool is_binary_cif(std::string_view bytes);

/// Takes some thousand rows of _atom_site, which the block has at that moment; `first`: how many of the table came
/// before. What follows the table in the file is not known yet.
using TakeAtomRows = std::function<void(gemmi::cif::Block& block, std::size_t first)>;

/// Parses the whole file once; of BinaryCIF, what readers look for (binary_cif.h). Rows of _atom_site are handed over
/// as they are read and not kept, for all of them as text take three times the memory of all atoms; the table without
/// rows stays. Throws InputError with the line where it is not CIF, and what `take` throws.
gemmi::cif::Document parse_cif(const TextFile& file, const TakeAtomRows& take);

}  // namespace meniscus
