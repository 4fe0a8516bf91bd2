// SPDX-License-Identifier: BSD-3-Clause
// Checks that all of a surface is there, with an oracle that knows only the balls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/surface/primitives.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {

struct Completeness {
  std::string lost;         ///< an exposed point that no patch has: one line; empty if there is none
  std::string wrong;        ///< a covered point that a patch has, or an area that the points contradict
  std::size_t asked = 0;    ///< points that were tested
  std::size_t skipped = 0;  ///< tested points that are nearer to some sphere than growth may have moved it
};

/// Å: the most by which radii may differ between the given balls and those whose exact surface this is: the growth of
/// decisions, and that of ties (Certificate::grown_by).
double allowed_growth(const Surface& surface);

/// Random points on the SAS sphere of every atom, `directions` for each. Growth by g moves a point by g at most, and
/// every other sphere too: so a point farther than 2g outside of all other SAS balls is exposed, whatever was decided
/// at ties, and one deeper than 2g in one of them is covered. What lies between is skipped. An exposed point is on a
/// patch of its atom, by that patch's planes; a covered one is on none; and areas are as large as the points say. An
/// atom that another one swallows (swallowed_atoms()) has no patch, so all its points are covered but for 1e-6 Å.
/// surface: of `balls`, in their order.
Completeness check_completeness(const Surface& surface, const Balls& balls, int directions, std::uint32_t seed);

}  // namespace meniscus::testing
