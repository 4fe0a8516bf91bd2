// SPDX-License-Identifier: BSD-3-Clause
// --save-camera: the camera of a picture as a file for --camera.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "core/base/output_file.h"
#include "core/camera/camera.h"

namespace meniscus {

/// For commands that save the camera, of a run in which it moves.
inline constexpr const char* kNoSingleCamera = "--save-camera: a camera that moves is no single one";

/// --save-camera. The path must live as long as the command; empty: it is not saved.
void add_save_camera_option(CLI::App& command, std::string& path);

/// Before the work begins: throws OutputError if save_camera could not write there.
void check_camera_file(const std::string& path, Existing existing);

/// Writes the camera, if a path is given. Throws OutputError.
void save_camera(const std::string& path, Existing existing, const Camera& camera);

}  // namespace meniscus
