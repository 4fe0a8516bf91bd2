// SPDX-License-Identifier: BSD-3-Clause
// The report of `meniscus surface --patches`: contiguous areas of some atoms, as a table, JSON and CSV.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/queries/atom_patches.h"
#include "core/scene/molecule.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

struct PatchReport {
  std::string selection;           ///< the expression for the atoms
  double least = 0.0;              ///< Å²: smaller patches are not listed
  double area = 0.0;               ///< Å², of all patches, in one copy of each object
  std::size_t count = 0;           ///< number of all patches
  std::vector<AtomPatch> patches;  ///< the listed patches, the largest first; atoms are indices into the structure
};

/// Finds the patches of all objects. Throws RequestError if the expression selects no atom of the surface.
PatchReport patch_report(const Molecule& molecule, const Selection& selection, double least);

/// Returns "selection", "least_area", "area" and "count" of all patches, and "list".
nlohmann::ordered_json patch_json(const PatchReport& report, const Structure& structure);
/// Returns a table for people, which begins with an empty line.
std::string patch_table(const PatchReport& report, const Structure& structure);

/// Returns patch,area,atoms,residues.
std::string patch_csv_header();
std::string patch_csv_rows(const PatchReport& report, const Structure& structure, const std::string& prefix);

}  // namespace meniscus
