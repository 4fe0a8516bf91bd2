// SPDX-License-Identifier: BSD-3-Clause
// Atoms that occur at several places (Instances), as a list of all of them or of those that matter for a camera.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/color/coloring.h"
#include "core/math/ball.h"
#include "core/structure/structure.h"

namespace meniscus {

/// Of one atom: the group it belongs to, and which of its motions.
struct CopiedAtom {
  std::uint32_t atom = 0, copy = 0;
};

/// How many atoms all copies have.
std::size_t placed_count(std::span<const Instances> copies);

/// Every atom of every copy: group by group, copy by copy, as merged() has the surfaces of the groups.
std::vector<CopiedAtom> placed_atoms(std::span<const Instances> copies);

/// Where these are. balls: of the atoms, where the groups' first copy is not moved.
std::vector<Ball> placed_balls(std::span<const Ball> balls, std::span<const Instances> copies);

/// The balls of a structure's atoms, one each, or of all copies as reaching_balls() has them. picked: per atom, whether
/// it counts; empty: all do.
std::vector<Ball> standing_balls(const Structure& structure, const std::vector<bool>& picked = {});

/// The colours of some atoms, in their order; each may be there several times.
Coloring coloring_of(const Coloring& coloring, std::span<const std::uint32_t> atoms);

/// Balls that reach as far as all copies do, for a camera that should see them all: those of every copy, or where these
/// are more than a million, of each copy those that reach farthest in one of 124 directions.
std::vector<Ball> reaching_balls(std::span<const Ball> balls, std::span<const Instances> copies);

}  // namespace meniscus
