// SPDX-License-Identifier: BSD-3-Clause
// BinaryCIF: a CIF file whose columns are stored as arrays of bytes in MessagePack.
#pragma once

#include <gemmi/cifdoc.hpp>

#include "core/base/text_file.h"

namespace meniscus {

/// Returns the tables of atoms, entities, secondary structure and assemblies, in the form of parse_cif. Throws
/// InputError if the bytes (TextFile::text) are not BinaryCIF, if they unpack to far more than a molecule of their
/// size, or if this build cannot read BinaryCIF.
gemmi::cif::Document read_binary_cif(const TextFile& file);

}  // namespace meniscus
