// SPDX-License-Identifier: BSD-3-Clause
// Implements --select-once: selections that depend on positions keep the atoms of the first frame in all frames of a
// run.
#pragma once

#include "core/scene/scene.h"

namespace meniscus {

/// If RunRequest::select_once is set, replaces all selections of the scene that depend on positions by the atoms that
/// they select in the first frame. Must be called before the scene is used. of_atoms: further selections, of atoms of
/// the surface. Throws RequestError if no selection depends on positions; otherwise like FrameRun.
void freeze_selections(Scene& scene, const std::vector<Selection*>& of_atoms = {});

}  // namespace meniscus
