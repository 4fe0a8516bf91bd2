// SPDX-License-Identifier: BSD-3-Clause
// What a figure shows as meshes, spheres and cylinders, for scenes of other programs.
#pragma once

#include <span>

#include "app/commands/figure_run.h"
#include "core/camera/camera.h"
#include "exporters/path_tracers/scene.h"

namespace meniscus {

/// A figure's scene, and how fine it is.
struct TracedScene {
  path_tracers::Scene scene;
  double tolerance = 0.0;  ///< Å
};

/// Of a frame of the run, or of its one molecule: the surface with caps where planes cut it, and all beside it. Scenes
/// of a run have one origin, and are as fine as its first camera needs, unless another tolerance is asked for. Throws
/// as capped_mesh() does.
TracedScene traced_scene(const FigureRun& run, FigureFrame frame);

}  // namespace meniscus
