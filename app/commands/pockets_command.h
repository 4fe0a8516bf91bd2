// SPDX-License-Identifier: BSD-3-Clause
// What the options of `meniscus pockets` say, for its two halves: one molecule, and runs of frames.
#pragma once

#include <string>
#include <vector>

#include "app/options/scene_options.h"
#include "core/pockets/pockets.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

struct PocketsCommand : SceneCommand {
  PocketRequest pockets;
  Selection ligand = parse_selection("ligand");
  bool json = false;
  std::string csv;     ///< path; empty: none; "-": standard output
  std::string mesh;    ///< path; empty: none
  std::string figure;  ///< path of a scene; empty: none
  double mesh_tolerance = 0.02;
};

/// Per atom of the structure, whether it is taken out. Throws InputError if nothing would be left.
std::vector<bool> taken_out(const PocketsCommand& command, const Structure& structure);

/// A line or a row for every frame, as soon as it is there (pockets_frames.cpp). Files get their names at the end, with
/// the frames that could be made.
void pockets_frames(const PocketsCommand& command);

}  // namespace meniscus
