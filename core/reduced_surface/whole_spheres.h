// SPDX-License-Identifier: BSD-3-Clause
// Decides which SAS spheres without an arc are exposed, and whether the arcs that were found can be complete.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {

struct Ball;

/// Sets lone_atoms and lost_atoms of a reduced surface. Its arcs must have been found already.
///
/// A sphere on which no arc is exposed is exposed as a whole or not at all, so each of its points decides (theorem 4).
/// Two opposite points are asked, of the balls alone and by the decision weights: whatever found the arcs has no say.
/// Exposed spheres that meet no other are lone. A sphere whose points disagree, or which is exposed and meets another,
/// has arcs that are missing: its atom is lost.
///
/// atoms: van der Waals balls in Å; weights, swallowed: decision_weights() and swallowed_atoms() of these.
void find_whole_spheres(std::span<const Ball> atoms, std::span<const double> weights,
                        const std::vector<bool>& swallowed, ReducedSurface& rs);

}  // namespace meniscus
