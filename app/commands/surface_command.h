// SPDX-License-Identifier: BSD-3-Clause
// The options of `meniscus surface`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/options/scene_options.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

struct SurfaceCommand : SceneCommand {
  bool json = false;
  bool open_sky = false;  ///< a column of atom_csv
  std::string atom_csv, residue_csv, series_csv, cavity_csv,
      gradient_csv;  ///< paths; empty: none; "-": standard output
  std::string plot;  ///< path of an SVG of a run; empty: none
  std::optional<Selection> context;
  std::string patch_csv;    ///< as above
  std::string summary_csv;  ///< path of a table of many files; empty: there is one molecule
  bool resumes = false;     ///< goes on with what is there of summary_csv

  /// Does a table take the place of what is printed else?
  bool prints_csv() const;
};

/// Throws UsageError for outputs that get into each other's way, OutputError for what cannot be written.
void check_outputs(const SurfaceCommand& command);

/// Numbers of the molecule, or a line or a row for every frame, as soon as it is there, in every output that is asked
/// for (surface_tables.cpp). Files get their names at the end, with the frames that could be made.
void print_surface(const SurfaceCommand& command);

/// --csv-summary (surface_summary.cpp): numbers of many molecules, one row a file.
/// Computes the molecule's file and, where a run has its trajectories, further ones, several at once. Rows go to
/// FILE.part, in the order of the files, each as soon as it is whole; at the end that becomes FILE. A file that cannot
/// be computed has a row that says why. Likewise rows of atoms and residues, which begin with the file. Throws
/// UsageError for what goes with one molecule alone, OutputError; at the end RunError, with the code of the first file
/// that failed.
void print_summary(const SurfaceCommand& command);

}  // namespace meniscus
