// SPDX-License-Identifier: BSD-3-Clause
// Motion blur: a picture of a run as the mean of several moments, while a shutter is open.
#pragma once

#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "core/camera/camera.h"
#include "core/gpu/egl_context.h"
#include "core/render/picture.h"
#include "core/scene/figure.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"
#include "core/scene/scene.h"

namespace meniscus {

/// Draws frames of a run blurred. The shutter is open for half the time from a frame to the next (a shutter of 180
/// degrees), a quarter before the frame and a quarter after it; before the first frame and after the last one nothing
/// moves. Between frames, atoms are at the positions of --interpolate, and the camera is between the cameras of both
/// frames.
class MotionBlur {
 public:
  /// scene: a run, made by prepared_scene(), after freeze_selections(); it must outlive this object.
  /// moments: number of moments in a picture, at least 2. cameras: one for all frames, or one per frame. context:
  /// computes surfaces on GL; nullptr: on the CPU. Throws RequestError for an interface, and for frames without moments
  /// between them: see RunRequest::interpolate.
  MotionBlur(const Scene& scene, int moments, std::vector<Camera> cameras, const EglContext* context);

  /// Returns the picture of the molecule at this place of the run: the mean of the pictures of its moments, in linear
  /// light. May be called on any thread, by one at a time. Throws like reading, computing and drawing.
  Framebuffer draw(std::uint64_t place, StillRenderer& renderer, RenderSettings settings);

 private:
  Camera camera(std::uint64_t place, double later) const;

  const Scene& scene_;
  int moments_;
  std::vector<Camera> cameras_;
  FrameRun run_;  ///< the run, with all moments among its frames
  MoleculeBuilder builder_;
  std::mutex mutex_;
};

}  // namespace meniscus
