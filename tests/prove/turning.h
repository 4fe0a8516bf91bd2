// SPDX-License-Identifier: BSD-3-Clause
// Checks that a surface stays the same when its atoms are turned and reordered.
#pragma once

#include <cstdint>
#include <string>

#include "core/surface/primitives.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {

struct Turning {
  bool refused = false;   ///< OpenSurfaceError for the turned input, but not for the given one
  bool lost = false;      ///< part of the turned surface is missing (completeness.h); the complaint says which
  bool tied = false;      ///< another surface within the effect of growth, by the bounds of check_turning()
  std::string complaint;  ///< what is missing, wrong, or neither the same nor explained: one line
};

/// Areas and volumes of the turned and reordered atoms are those of `surface`, but for rounding. Where they are not,
/// decisions at a tie fell otherwise, and each of the two is the exact surface of radii that are larger by at most
/// allowed_growth(). The solid grows with the radii. So, with g three times that growth, either volume has to lie
/// between those of all radii smaller by g and larger by g; and where all sizes of these two agree but for rounding,
/// both have to agree with them. Either is give or take the surface's area times the way by which growth moves a probe
/// where spheres touch, the root of 2Rg. What keeps these bounds is a tie; all else is an error.
Turning check_turning(const Surface& surface, const Balls& balls, std::uint32_t seed);

}  // namespace meniscus::testing
