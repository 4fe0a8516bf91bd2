// SPDX-License-Identifier: BSD-3-Clause
// Atoms that occur at several places (Instances), as a list of all of them or of those that matter for a camera.
#pragma once

#include "core/color/coloring.h"
#include "core/math/ball.h"
#include "core/structure/structure.h"

namespace meniscus {

/// One copy of an atom: the atom, and the place of its motion among the motions of its group.
struct CopiedAtom {
  std::uint32_t atom = 0, copy = 0;
};

/// Returns the number of atoms of all copies together.
std::size_t placed_count(std::span<const Instances> copies);

/// Returns every atom of every copy: group by group, copy by copy, in the order in which merged() has the surfaces of
/// the groups.
std::vector<CopiedAtom> placed_atoms(std::span<const Instances> copies);

/// Returns the balls of all copies in the order of placed_atoms(). balls: one per atom of the structure, at the place
/// that it has in an unmoved copy.
std::vector<Ball> placed_balls(std::span<const Ball> balls, std::span<const Instances> copies);

/// Returns the balls of a structure's atoms, one per atom; if the structure has copies, the balls of the copies as in
/// reaching_balls(). picked: per atom, true if it is included; empty: all are.
std::vector<Ball> standing_balls(const Structure& structure, const std::vector<bool>& picked = {});

/// Returns the colours of these atoms in the given order. An atom may occur several times.
Coloring coloring_of(const Coloring& coloring, std::span<const std::uint32_t> atoms);

/// Returns balls that extend as far as all copies do, for a camera that must see all of them: the balls of every copy
/// or, if there are more than a million, the balls of each copy that reach farthest in one of 124 directions.
std::vector<Ball> reaching_balls(std::span<const Ball> balls, std::span<const Instances> copies);

}  // namespace meniscus
