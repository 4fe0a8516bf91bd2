// SPDX-License-Identifier: BSD-3-Clause
// Draws the bases of nucleic acids as filled rings on rungs from the backbone.
#pragma once

#include <vector>

#include "core/shapes/shapes.h"

namespace meniscus {

/// Returns the shapes of each nucleotide with a selected base: its rings as plates with round rims, twice the radius
/// (Å) thick, and a rung from there by C1' to the middle line of backbone(). Rings are recognised by the numbers of
/// their atoms, so that modified bases have them, too; a ring that is incomplete or not closed is left out. Plates have
/// the colour of C4, rims those of their atoms.
Shapes bases(const Structure& structure, const std::vector<bool>& selected, double radius = kStickRadius);

}  // namespace meniscus
