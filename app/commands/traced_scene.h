// SPDX-License-Identifier: BSD-3-Clause
// A figure as meshes, spheres and cylinders, for scenes of other programs.
#pragma once

#include <span>

#include "app/commands/command_run.h"
#include "core/camera/camera.h"
#include "exporters/path_tracers/path_tracer_scene.h"

namespace meniscus {

/// Returns the properties of exports for path tracers.
TakenProperties traced_properties();

/// A figure's scene, and its fineness.
struct TracedScene {
  path_tracers::Scene scene;
  double tolerance = 0.0;  ///< Å
};

/// Makes the scene of a frame of the run, or of its one molecule: the surface with caps where planes cut it, and
/// everything drawn in addition. Scenes of a run have one origin, and the fineness that its first camera needs, unless
/// another tolerance is set. Throws like capped_mesh().
TracedScene traced_scene(const FigureRun& run, FigureFrame frame);

}  // namespace meniscus
