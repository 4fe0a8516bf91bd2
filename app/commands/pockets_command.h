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

/// Prints the pockets of the molecule, or a line or a row for every frame as soon as it is finished
/// (pocket_tables.cpp). Tables get their final names at the end, with the frames that could be made; there is one mesh
/// and one scene per frame.
void print_pockets(const PocketsCommand& command);

}  // namespace meniscus
