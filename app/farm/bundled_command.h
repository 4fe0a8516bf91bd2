// SPDX-License-Identifier: BSD-3-Clause
// What stands behind `farm bundle ... --`: a framed command of this program, understood but not run.
#pragma once

#include <string>
#include <vector>

#include "app/options/molecule_options.h"
#include "app/options/picture_options.h"
#include "core/scene/run_cameras.h"
#include "app/options/frame_options.h"

namespace meniscus::farm {

struct BundledCommand {
  std::vector<std::string> words;      ///< {"render"}, {"export", "povray"} and others of bundled_steps.h
  std::vector<std::string> arguments;  ///< behind the words, as written: FILE first
  std::vector<std::string> device;     ///< those of them that say where it is computed, taken out
  std::vector<std::string> renderer;   ///< what stood behind a second --: for POV-Ray, or Blender's driver

  MoleculeOptions molecule;
  FrameOptions frames;
  ViewRequest picture;
  CameraMotionRequest camera_motion;

  /// A word in `arguments` that is the path of a file to read, or has it behind "--option=".
  struct File {
    std::size_t place = 0;  ///< in `arguments`
    std::string prefix;     ///< "" or "--option="
    std::string path;
  };
  std::vector<File> files;
};

}  // namespace meniscus::farm
