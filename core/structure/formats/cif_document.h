// SPDX-License-Identifier: BSD-3-Clause
// The one place where CIF text is parsed, by gemmi.
#pragma once

#include <gemmi/cifdoc.hpp>

#include "core/base/text_file.h"

namespace meniscus {

/// Parses the whole file once. Throws InputError with the line where it is no CIF.
gemmi::cif::Document parse_cif(const TextFile& file);

}  // namespace meniscus
