// SPDX-License-Identifier: BSD-3-Clause
// The options that say how a picture is taken: its size and its camera.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "core/camera/view_request.h"

namespace meniscus {

/// --size alone; `what` has it. The request must live as long as the command.
void add_size_option(CLI::App& command, ViewRequest& request, const std::string& what);

/// --size, --dpi, --width, --height, --camera, --projection, --view, --turn, --zoom-to.
void add_picture_options(CLI::App& command, ViewRequest& request);

}  // namespace meniscus
