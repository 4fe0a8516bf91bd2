// SPDX-License-Identifier: BSD-3-Clause
// --select-once: selections that depend on positions keep the atoms of the first frame in all frames of a run.
#pragma once

#include <vector>

#include "core/scene/scene.h"

namespace meniscus {

/// If RunRequest::select_once says so, settles all selections of the scene that depend on positions, before anything is
/// made of them. of_atoms: more of them, of atoms of the surface. Throws RequestError where there are none; else as
/// FrameRun.
void settle_selections(Scene& scene, const std::vector<Selection*>& of_atoms = {});

}  // namespace meniscus
