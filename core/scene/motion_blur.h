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
/// moves. Between frames atoms are where --interpolate has them, and the camera between those of both.
class MotionBlur {
 public:
  /// scene: readied(), with its selections settled, of a run; it must stay. moments: of a picture, at least 2. cameras:
  /// one for all frames, or one for each. context: in which surfaces are computed; nullptr: on the CPU. Throws
  /// RequestError where frames have nothing between them: see RunRequest::interpolate; for an interface.
  MotionBlur(const Scene& scene, int moments, std::vector<Camera> cameras, const EglContext* context);

  /// The molecule at this place of the run: the mean of its pictures, in linear light. On any thread, one at a time.
  /// Throws as reading, computing and drawing do.
  Framebuffer draw(std::uint64_t place, StillRenderer& renderer, RenderSettings settings);

 private:
  Camera camera(std::uint64_t place, double later) const;

  const Scene& scene_;
  int moments_;
  std::vector<Camera> cameras_;
  FrameRun run_;  ///< with all moments among its frames
  MoleculeBuilder builder_;
  std::mutex mutex_;
};

}  // namespace meniscus
