// SPDX-License-Identifier: BSD-3-Clause
// The options that move the camera over a run of frames.
#pragma once

#include <CLI/CLI.hpp>

#include "core/scene/run_cameras.h"

namespace meniscus {

/// --camera-path, --turntable, --follow. The request must live as long as the command.
void add_run_camera_options(CLI::App& command, CameraMotionRequest& motion);

}  // namespace meniscus
