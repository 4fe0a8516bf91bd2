// SPDX-License-Identifier: BSD-3-Clause
// The command after `farm bundle ... --`: parsed, but not run.
#pragma once

#include <string>
#include <vector>

#include "app/options/scene_options.h"

namespace meniscus::farm {

struct BundledCommand {
  std::vector<std::string> words;     ///< {"render"}, {"export", "povray"} and others of steps_of()
  SceneCommand command;               ///< its scene, complete
  std::vector<std::string> further;   ///< options that are not of the scene: --provenance
  std::vector<std::string> device;    ///< options that say where it is computed
  std::vector<std::string> renderer;  ///< what stood behind a second --: for POV-Ray, or Blender's driver
};

}  // namespace meniscus::farm
