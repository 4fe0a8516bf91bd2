// SPDX-License-Identifier: BSD-3-Clause
// --select-once: selections that depend on positions keep the atoms of the first frame in all frames of a run.
#pragma once

#include <vector>

#include "core/camera/view_request.h"
#include "core/scene/figure.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"
#include "core/scene/run_cameras.h"

namespace meniscus {

/// What else of a command has expressions; nullptr: it has none of these.
struct OtherSelections {
  FigureRequest* figure = nullptr;
  ViewRequest* view = nullptr;
  CameraMotionRequest* motion = nullptr;
  std::vector<Selection*> of_atoms{};  ///< of the surface
};

/// If RunRequest::select_once says so, all expressions that ask for positions are settled. Must come before anything is
/// made of them. Throws RequestError where there are none; else as FrameRun.
void settle_selections(MoleculeRequest& molecule, RunRequest& run, const OtherSelections& others = {});

}  // namespace meniscus
