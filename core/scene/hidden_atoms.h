// SPDX-License-Identifier: BSD-3-Clause
// --show: the surface of all atoms is computed, and only a part of it is shown.
#pragma once

#include <vector>

#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"
#include "core/queries/surface_object.h"

namespace meniscus {

/// Per atom of the structure, whether it is not selected; the expression may speak of atoms beside it. Throws
/// InputError if nothing would be seen.
std::vector<bool> hidden_atoms(const Selection& shown, const Structure& structure);

/// Hides the points of these atoms in every object. hidden: per atom of the structure.
void hide(const std::vector<bool>& hidden, std::vector<SurfaceObject>& objects);

}  // namespace meniscus
