// SPDX-License-Identifier: BSD-3-Clause
// What stands behind `farm bundle ... --`: a framed command of this program, understood but not run.
#pragma once

#include <string>
#include <vector>

#include "app/options/molecule_options.h"
#include "app/options/picture_options.h"
#include "app/run_camera.h"
#include "app/options/sequence_options.h"

namespace meniscus::farm {

struct WrappedCommand {
  std::vector<std::string> words;      ///< {"render"}, {"export", "povray"} or {"export", "blender"}
  std::vector<std::string> arguments;  ///< behind the words, as written: FILE first
  std::vector<std::string> device;     ///< those of them that say where it is computed, taken out
  std::vector<std::string> renderer;   ///< what stood behind a second --: for POV-Ray, or Blender's driver

  MoleculeOptions molecule;
  SequenceOptions sequence;
  PictureOptions picture;
  RunCameraOptions camera_motion;

  /// A word in `arguments` that is the path of a file to read, or has it behind "--option=".
  struct File {
    std::size_t place = 0;  ///< in `arguments`
    std::string prefix;     ///< "" or "--option="
    std::string path;
  };
  std::vector<File> files;
};

/// Checks the words by the program's own parser. Throws UsageError: no framed command, wrong options, options that a
/// bundle decides by itself; what the parser's callbacks throw. `result` is filled in place, for options refer to it.
void parse_wrapped_command(const std::vector<std::string>& words, WrappedCommand& result);

}  // namespace meniscus::farm
