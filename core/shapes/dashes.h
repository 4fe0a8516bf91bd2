// SPDX-License-Identifier: BSD-3-Clause
// Dashed lines between pairs of atoms, and the closest pair of two sets.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/shapes/shapes.h"
#include "core/structure/structure.h"

namespace meniscus {

inline constexpr double kDashRadius = 0.08;  ///< Å, the default radius of dashed lines

/// Returns the dashes of straight lines between the atoms of each pair (places in `atoms`), as short cylinders with
/// round ends. Lines begin and end with half a gap. Each dash has the nearer atom. radius: Å, > 0.
Shapes dashes(std::span<const Atom> atoms, std::span<const Bond> pairs, double radius = kDashRadius);

/// Returns the two different atoms, one of each set, that have the smallest distance; of several such pairs, the first
/// in ascending order. Returns nothing if there is none. one, other: one truth value for each atom.
std::optional<Bond> closest_pair(std::span<const Atom> atoms, const std::vector<bool>& one,
                                 const std::vector<bool>& other);

}  // namespace meniscus
