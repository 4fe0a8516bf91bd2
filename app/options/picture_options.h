// SPDX-License-Identifier: BSD-3-Clause
// The options that say how a picture is taken: its size and its camera.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <glm/vec3.hpp>

#include "core/camera/view_request.h"
#include "core/scene/run_cameras.h"

namespace meniscus {

/// --size alone; `what` has it. The request must live as long as the command.
void add_size_option(CLI::App& command, ViewRequest& request, const std::string& what);

/// "1.5pt", "0.5mm", "3px" or "3" as pixels of a picture, whose --dpi must have been declared before the option;
/// lengths take 300 dots an inch where nothing else was said, and then the picture has them. Throws
/// CLI::ValidationError.
double pixels_of(const char* option, const std::string& text, ViewRequest& request);

/// --size, --dpi, --width, --height, --camera, --projection, --view, --turn, --zoom-to.
void add_picture_options(CLI::App& command, ViewRequest& request);

/// --background; nothing: transparent. The colour must live as long as the command.
void add_background_option(CLI::App& command, std::optional<glm::vec3>& background);

/// --camera-path, --turntable, --follow, for commands that also have the options of pictures.
void add_run_camera_options(CLI::App& command, CameraMotionRequest& motion);

}  // namespace meniscus
