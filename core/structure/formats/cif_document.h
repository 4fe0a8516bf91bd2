// SPDX-License-Identifier: BSD-3-Clause
// Parses CIF with gemmi, or decodes BinaryCIF, at this one place.
#pragma once

#include <string_view>

#include <gemmi/cifdoc.hpp>

#include "core/base/text_file.h"

namespace meniscus {

/// By the first bytes: a map of MessagePack whose first key is one of BinaryCIF's.
bool is_binary_cif(std::string_view bytes);

/// Parses the whole file once; of BinaryCIF, what readers look for (binary_cif.h). Throws InputError with the line
/// where it is not CIF.
gemmi::cif::Document parse_cif(const TextFile& file);

}  // namespace meniscus
