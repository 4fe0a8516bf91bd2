// SPDX-License-Identifier: BSD-3-Clause
// The output of `meniscus surface`: a table for people, a JSON object for programs.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/reports/csv_tables.h"
#include "app/reports/patch_report.h"
#include "core/scene/area_columns.h"
#include "core/scene/molecule.h"

namespace meniscus {

/// The atoms that --context added around the molecule.
struct ContextNote {
  std::string selection;
  std::size_t atoms = 0;
};

/// All numbers of a molecule's surfaces. `columns`: areas of its atoms.
struct SurfaceReport {
  const Molecule& molecule;
  const MoleculeRequest& options;
  const std::vector<AreaColumn>& columns;
  const std::optional<ContextNote>& context;
  const std::optional<PatchReport>& patches;
};

/// Returns indented JSON that ends with a line feed.
std::string report_json(const SurfaceReport& report);
std::string report_table(const SurfaceReport& report);

/// Returns the object of report_json in one line that begins with "frame" and "time" (null if unknown).
std::string report_json_line(const SurfaceReport& report, const FrameNote& note);
/// Returns a row of the table of a run; the next function returns its header.
std::string report_row(const SurfaceReport& report, const FrameNote& note);
std::string report_row_header(const MoleculeRequest& options);

}  // namespace meniscus
