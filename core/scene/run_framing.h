// SPDX-License-Identifier: BSD-3-Clause
// What all frames of a run share, whichever process makes them: cameras, extent, colours.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "core/scene/run_cameras.h"
#include "core/scene/shown_frames.h"
#include "core/color/color_schemes.h"
#include "core/camera/camera.h"

namespace meniscus {

struct RunFraming {
  std::vector<Camera> cameras;  ///< one, or one a frame if it moves
  RunExtent extent;

  /// Where coordinates of scenes begin, Å, to three decimals.
  glm::dvec3 origin() const;
};

/// Reads all frames of the run once. Throws what run_cameras throws.
RunFraming run_framing(const ViewRequest& view, const CameraMotionRequest& motion, const GivenCameras& given,
                       ShownFrames& frames);

/// Takes from all frames of the run what its colours mean in each of them: fluctuations, and one range of numbers that
/// change with the places of atoms. Reads the run again for each scheme that needs it. Throws what fluctuations throws.
void measure_colors(ColorScheme& color, ShownFrames& frames);

/// FrameRun::reach() with the number of the first frame, of which a file may have numbers.
Structure numbered_reach(const FrameRun& frames);

/// All colours that a frame of the run may have, in the order of the atoms; of components all there are. Of schemes
/// that do not change with the frames.
std::vector<glm::vec3> run_colors(const Structure& structure, const ColorScheme& scheme, const Coloring& beside = {});

}  // namespace meniscus
