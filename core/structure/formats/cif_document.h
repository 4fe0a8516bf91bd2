// SPDX-License-Identifier: BSD-3-Clause
// Parses CIF text with gemmi, at this one place.
#pragma once

#include <gemmi/cifdoc.hpp>

#include "core/base/text_file.h"

namespace meniscus {

/// Parses the whole file once. Throws InputError with the line where it is not CIF.
gemmi::cif::Document parse_cif(const TextFile& file);

}  // namespace meniscus
