// SPDX-License-Identifier: BSD-3-Clause
// What `meniscus surface --patches` reports: contiguous areas of some atoms, as a table, JSON and CSV.
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
  std::string selection;           ///< of the atoms
  double least = 0.0;              ///< Å²: smaller ones are not listed
  double area = 0.0;               ///< Å², of all patches, of one copy of each object
  std::size_t count = 0;           ///< of all patches
  std::vector<AtomPatch> patches;  ///< those that are listed, the largest first; atoms: of the structure
};

/// Of all objects. Throws RequestError if the expression selects no atom of the surface.
PatchReport patch_report(const Molecule& molecule, const Selection& selection, double least);

/// "selection", "least_area", "area" and "count" of all, and "list".
nlohmann::ordered_json patch_json(const PatchReport& report, const Structure& structure);
/// Begins with an empty line.
std::string patch_table(const PatchReport& report, const Structure& structure);

/// patch,area,atoms,residues
std::string patch_csv_header();
std::string patch_csv_rows(const PatchReport& report, const Structure& structure, const std::string& prefix);

}  // namespace meniscus
