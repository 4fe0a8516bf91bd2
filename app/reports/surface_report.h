// SPDX-License-Identifier: BSD-3-Clause
// Numbers of a surface and of its patches as text and JSON, and series over the frames of a run as curves in an SVG.
#pragma once

#include <nlohmann/json.hpp>

#include "app/reports/csv_tables.h"
#include "core/queries/surface_parts.h"
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

/// The atoms that --context added around the molecule.
struct ContextNote {
  std::string selection;
  std::size_t atoms = 0;
};

/// All numbers of a molecule's surfaces. `columns`: areas of its atoms; `timed`: the table has the times of stages.
struct SurfaceReport {
  const Molecule& molecule;
  const MoleculeRequest& options;
  const std::vector<AreaColumn>& columns;
  const std::optional<ContextNote>& context;
  const std::optional<PatchReport>& patches;
  bool timed = false;
};

/// Returns indented JSON that ends with a line feed.
std::string report_json(const SurfaceReport& report);
std::string report_table(const SurfaceReport& report);

/// Returns the object of report_json in one line that begins with "frame" and "time" (null if unknown).
std::string report_json_line(const SurfaceReport& report, const FrameNote& note);
/// Returns a row of the table of a run; the next function returns its header.
std::string report_row(const SurfaceReport& report, const FrameNote& note);
std::string report_row_header(const MoleculeRequest& options);

/// A curve in a panel of its own.
struct PlotPanel {
  std::string title;           ///< a word of this program with its unit, never text of a file
  std::vector<double> values;  ///< one per SeriesPlot::x
};

struct SeriesPlot {
  std::string x_title;
  std::vector<double> x;  ///< in any order, at least one
  std::vector<PlotPanel> panels;
};

/// Returns the plot as SVG 1.1 that consists only of lines and text; it ends with a line feed. Ticks are at 1, 2 or 5
/// times a power of ten; curves fill their panels.
std::string plot_svg(const SeriesPlot& plot);

}  // namespace meniscus
