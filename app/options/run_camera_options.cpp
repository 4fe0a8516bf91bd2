// SPDX-License-Identifier: BSD-3-Clause
// Declares the options of a moving camera.
#include "app/options/run_camera_options.h"

#include "app/options/molecule_options.h"

namespace meniscus {

void add_run_camera_options(CLI::App& command, CameraMotionRequest& motion) {
  const Heading heading(command, "Frames");
  CLI::Option* const path =
      command.add_option("--camera-path", motion.path_file, "Key frames of the camera as JSON: frame, camera");
  path->type_name("FILE");
  for (const char* name : {"--camera", "--view", "--turn", "--zoom-to"}) path->excludes(command.get_option(name));
  command
      .add_option("--turntable", motion.turns,
                  "Turns of the camera about the molecule's middle over the run; negative: the other way round")
      ->type_name("TURNS");
  command
      .add_option_function<std::string>(
          "--follow", [&motion](const std::string& text) { motion.follow = parse_selection_option("--follow", text); },
          "Move the camera with the middle of these atoms")
      ->type_name("EXPR");
}

}  // namespace meniscus
