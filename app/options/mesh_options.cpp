// SPDX-License-Identifier: BSD-3-Clause
// Declares the mesh options.
#include "app/options/mesh_options.h"

namespace meniscus {

void add_mesh_options(CLI::App& command, MeshRequest& request) {
  CLI::Option* const angstrom =
      command.add_option("--tolerance", request.tolerance, "Farthest the mesh may be from the surface, in Å [0.01]");
  angstrom->type_name("Å")->check(CLI::Range(kSmallestTolerance, kLargestTolerance));
  command.add_option("--tolerance-pixels", request.tolerance_pixels, "The same in pixels of the picture, e.g. 0.25")
      ->type_name("PIXELS")
      ->check(CLI::Range(1e-3, 100.0))
      ->excludes(angstrom);
}

}  // namespace meniscus
