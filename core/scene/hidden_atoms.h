// SPDX-License-Identifier: BSD-3-Clause
// Implements --show: the surface of all atoms is computed, and only a part of it is shown.
#pragma once

#include <vector>

#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"
#include "core/queries/surface_object.h"

namespace meniscus {

/// Returns, per atom of the structure, true if it is not selected. The expression may refer to atoms that are drawn in
/// addition to the surface. Throws InputError if nothing would be visible.
std::vector<bool> hidden_atoms(const Selection& shown, const Structure& structure);

/// Hides the points of these atoms in every object. hidden: per atom of the structure.
void hide(const std::vector<bool>& hidden, std::vector<SurfaceObject>& objects);

}  // namespace meniscus
