// SPDX-License-Identifier: BSD-3-Clause
// The options of `meniscus surface`.
#pragma once

#include "app/options/scene_options.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

struct SurfaceCommand : SceneCommand {
  bool json = false;
  bool open_sky = false;  ///< true if atom_csv has a column open_sky
  std::string atom_csv, residue_csv, series_csv, cavity_csv,
      gradient_csv;  ///< paths; empty: none; "-": standard output
  std::string plot;  ///< path of an SVG for a run; empty: none
  std::optional<Selection> context;
  std::string patch_csv;    ///< path as above
  std::string summary_csv;  ///< path of a table of many files; empty: there is one molecule
  bool resumes = false;     ///< true to continue an existing summary_csv

  /// Returns true if a table replaces the printed report.
  bool prints_csv() const;
};

/// Writes the numbers of many molecules for --csv-summary, one row per file (surface_summary.cpp). Computes the
/// molecule's file and further files, in place of the trajectories of a run, several at once. Rows go to FILE.part, in
/// the order of the files, each as soon as it is complete; at the end FILE.part becomes FILE. A file that cannot be
/// computed has a row with the reason. Rows of atoms and residues are written in the same way, and begin with the file.
/// Throws UsageError for options that need a single molecule, OutputError; at the end RunError, with the code of the
/// first file that failed.
void print_summary(const SurfaceCommand& command);

}  // namespace meniscus
