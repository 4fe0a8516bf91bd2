// SPDX-License-Identifier: BSD-3-Clause
// The table of formats, and the choice among them for a file.
#pragma once

#include <span>
#include <string>

#include "core/structure/formats/reader.h"

namespace meniscus {

/// All formats, as people list them.
std::span<const Reader* const> readers();

/// "PDB, mmCIF, PQR, GRO, XYZ, XYZR, PSF, prmtop"
std::string format_names();

/// The reader of a file: the format of its name if its content may be that, else the one its content is.
/// Throws InputError where the content is clearly another format than the name says, and where it is none.
const Reader& choose_reader(const TextFile& file);

}  // namespace meniscus
