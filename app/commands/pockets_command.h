// SPDX-License-Identifier: BSD-3-Clause
// The options of `meniscus pockets`.
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

/// Pockets of the molecule, or a line or a row for every frame, as soon as it is there (pocket_tables.cpp). Tables get
/// their names at the end, with the frames that could be made; meshes and scenes are a file a frame.
void print_pockets(const PocketsCommand& command);

}  // namespace meniscus
