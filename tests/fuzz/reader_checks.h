// SPDX-License-Identifier: BSD-3-Clause
// Conditions that every reader of molecules must meet for any input.
#pragma once

#include <string_view>
#include <vector>

#include "core/structure/formats/structure_formats.h"
#include "tests/fuzz/target.h"

namespace meniscus::fuzz {

/// Reads the bytes by this reader, one model and all; compares its quick reading of positions, builds its assemblies;
/// then goes the whole way from a file to a structure. `file`: the name has the format's extension.
void check_reader(const Reader& reader, const ScratchFile& file, std::string_view bytes);

/// Checks that numbers are finite or missing and within their bounds, and that no more atoms exist than a text of so
/// many bytes can name.
void check_contents(const FileContents& contents, std::size_t bytes);

/// Returns a dozen atoms of two residues, water and an ion, with all possible fields.
std::vector<Atom> sample_atoms();

}  // namespace meniscus::fuzz
