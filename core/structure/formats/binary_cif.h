// SPDX-License-Identifier: BSD-3-Clause
// BinaryCIF: the columns of a CIF file as arrays of bytes, in MessagePack.
#pragma once

#include <gemmi/cifdoc.hpp>

#include "core/base/text_file.h"

namespace meniscus {

/// The tables of atoms, entities, secondary structure and assemblies, as parse_cif gives them. Throws InputError where
/// the bytes (TextFile::text) are no BinaryCIF or unpack to far more than a molecule of their size, or where this build
/// reads none.
gemmi::cif::Document read_binary_cif(const TextFile& file);

}  // namespace meniscus
