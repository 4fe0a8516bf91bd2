// SPDX-License-Identifier: BSD-3-Clause
// What `meniscus surface` prints: a table for people, a JSON object for programs.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/area_columns.h"
#include "app/molecule.h"
#include "app/molecule_options.h"

namespace meniscus {

/// Which atoms --context put around the molecule.
struct ContextNote {
  std::string selection;
  std::size_t atoms = 0;
};

/// All numbers of a molecule's surfaces. `columns`: areas of its atoms.
struct SurfaceReport {
  const Molecule& molecule;
  const MoleculeOptions& options;
  const std::vector<AreaColumn>& columns;
  const std::optional<ContextNote>& context;
};

/// Indented, ends with a line feed.
std::string report_json(const SurfaceReport& report);
std::string report_table(const SurfaceReport& report);

}  // namespace meniscus
