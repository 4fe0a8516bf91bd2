// SPDX-License-Identifier: BSD-3-Clause
// From a file name to the atoms of a surface: format by content, one model, one alternate location, no water, no ions.
#pragma once

#include <span>
#include <string>

#include "core/molecule/assembly.h"
#include "core/molecule/reader.h"
#include "core/molecule/structure.h"

namespace meniscus {

/// What to do with atoms whose element nobody can tell.
enum class UnknownElement { halt, guess, skip };

struct ReadOptions {
  bool keep_water = false;
  bool keep_ions = false;
  UnknownElement unknown_element = UnknownElement::halt;  ///< guess: radius kRadiusWithoutSource; skip: leave out
  std::string assembly{};                                 ///< id of the assembly to build; empty: as deposited
  CopyMode copy_mode = CopyMode::atoms;                   ///< what becomes of its copies
  bool list_assemblies = false;                           ///< fill in Structure::assemblies
};

/// All formats, in the order their content is tried.
std::span<const Reader* const> readers();

/// Reads PDB, mmCIF or XYZR, plain or gzipped, told apart by content. Default: polymer and ligands in, water and free
/// ions out, first model, per residue the alternate location of highest mean occupancy (then lowest B-factor, then
/// letter). Radii: Bondi, or the file's own (XYZR).
/// Throws InputError (see read_text_file and the readers; no atoms left; unknown elements), CapacityError.
Structure read_structure(const std::string& path, const ReadOptions& options = {});

}  // namespace meniscus
