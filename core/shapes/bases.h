// SPDX-License-Identifier: BSD-3-Clause
// The bases of nucleic acids as filled rings on rungs from the backbone.
#pragma once

#include <vector>

#include "core/shapes/shapes.h"

namespace meniscus {

/// Of each nucleotide whose base is selected: its rings as plates with round rims, twice the radius (Å) thick, and a
/// rung from there by C1' to where backbone() has its middle line. Rings are known by the numbers of their atoms, so
/// that modified bases have them, too; a ring that is not whole or not closed is left out. Plates have the colour of
/// C4, rims those of their atoms.
Shapes bases(const Structure& structure, const std::vector<bool>& selected, double radius = kStickRadius);

}  // namespace meniscus
