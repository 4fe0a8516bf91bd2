// SPDX-License-Identifier: BSD-3-Clause
// Decides which SAS spheres without an arc are exposed, and whether the known arcs can be complete.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {

struct Ball;

/// Computes lone_atoms and lost_atoms of a reduced surface. Its arcs must have been found already.
///
/// A sphere without an exposed arc is exposed as a whole or not at all, so each of its points decides (theorem 4). Two
/// opposite points are tested against the balls alone, by the decision weights, independently of the method that found
/// the arcs. Exposed spheres that meet no other are lone. If the points of a sphere disagree, or if it is exposed and
/// meets another, arcs are missing: its atom is lost.
///
/// atoms: van der Waals balls in Å; weights, swallowed: decision_weights() and swallowed_atoms() of these.
void find_whole_spheres(std::span<const Ball> atoms, std::span<const double> weights,
                        const std::vector<bool>& swallowed, ReducedSurface& rs);

}  // namespace meniscus
