// SPDX-License-Identifier: BSD-3-Clause
// The cameras of a run of frames: still, turning, along a path, or following atoms.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/options/picture_options.h"
#include "app/sequence.h"
#include "core/structure/selection/selection.h"
#include "core/camera/camera_path.h"

namespace meniscus {

/// What the options say about the motion of the camera.
struct RunCameraOptions {
  std::string path_file;  ///< empty: one camera, from --camera or framing all frames
  double turns = 0.0;     ///< about the camera's up axis through the middle of the molecule, over the run
  std::optional<Selection> follow;

  bool moves() const { return !path_file.empty() || turns != 0.0 || follow.has_value(); }
};

/// --camera-path, --turntable, --follow.
void add_run_camera_options(CLI::App& command, RunCameraOptions& options);

/// The cameras that files give to a run.
struct GivenCameras {
  std::optional<Camera> still;
  std::optional<CameraPath> path;

  bool any() const { return still || path; }
};

/// Those of --camera and --camera-path. Commands ask for them before they read or compute anything. Throws InputError.
GivenCameras given_cameras(const PictureOptions& picture, const RunCameraOptions& options);

/// A camera for each frame of the run, by its place. Without a camera from a file all frames are read once, so that all
/// of every frame is seen. Throws InputError, UsageError.
std::vector<Camera> run_cameras(const PictureOptions& picture, const RunCameraOptions& options,
                                const GivenCameras& given, Sequence& sequence);

}  // namespace meniscus
