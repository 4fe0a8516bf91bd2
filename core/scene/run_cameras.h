// SPDX-License-Identifier: BSD-3-Clause
// The cameras of a run of frames: still, turning, along a path, or following atoms.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/camera/camera.h"
#include "core/camera/view_request.h"
#include "core/math/box.h"
#include "core/scene/shown_frames.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

/// How the camera moves over a run.
struct CameraMotionRequest {
  std::string path_file;  ///< empty: one camera, of a file or framing all frames
  double turns = 0.0;     ///< about the camera's up axis through the middle of what is framed, over the run
  std::optional<Selection> follow;

  bool moves() const { return !path_file.empty() || turns != 0.0 || follow.has_value(); }
};

/// The cameras that files give to a run.
struct GivenCameras {
  std::optional<Camera> still;
  std::optional<CameraPath> path;

  bool any() const { return still || path; }
};

/// Boxes around all atoms at all frames, Å.
struct RunExtent {
  Box surface;  ///< those of the surface
  Box shown;    ///< and those beside it
};

/// Those of the files that are named. Ask for them before anything is read or computed. Throws InputError.
GivenCameras given_cameras(const ViewRequest& view, const CameraMotionRequest& motion);

/// A camera for each frame of the run, by its place. Without a camera from a file, and where it is asked to fill the
/// picture with some atoms, all frames are read once, so that these are seen in every frame. extent: is found in the
/// same pass; nullptr: not asked for. Throws InputError, RequestError, and what opening an interface throws.
std::vector<Camera> run_cameras(const ViewRequest& view, const CameraMotionRequest& motion, const GivenCameras& given,
                                ShownFrames& frames, RunExtent* extent = nullptr);

}  // namespace meniscus
