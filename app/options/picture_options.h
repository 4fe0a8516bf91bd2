// SPDX-License-Identifier: BSD-3-Clause
// The options that say how a picture is taken: its size and its camera.
#pragma once

#include <optional>
#include <span>
#include <string>

#include <CLI/CLI.hpp>

#include "core/camera/camera.h"

namespace meniscus {

/// What the picture options say. Commands keep one of these alive as long as their CLI::App.
struct PictureOptions {
  int width = 1280, height = 960;                   ///< pixels
  std::string camera_file;                          ///< empty: a camera that shows all of the surface
  Projection projection = Projection::perspective;  ///< of that default camera
};

/// --size alone; `what` has it.
void add_size_option(CLI::App& command, PictureOptions& options, const std::string& what);

/// --size, --camera, --projection.
void add_picture_options(CLI::App& command, PictureOptions& options);

/// The camera of the file, if one is named. Commands ask for it before they compute anything. Throws InputError.
std::optional<Camera> given_camera(const PictureOptions& options);

/// The camera given, or the default one, which shows all of the balls.
Camera picture_camera(const PictureOptions& options, const std::optional<Camera>& given, std::span<const Ball> balls);

}  // namespace meniscus
