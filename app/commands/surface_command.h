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

}  // namespace meniscus
