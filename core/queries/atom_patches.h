// SPDX-License-Identifier: BSD-3-Clause
// The contiguous areas of a surface that belong to some of its atoms: hydrophobic patches, charged ones.
#pragma once

#include <cstdint>
#include <vector>

namespace meniscus {

struct Surface;

/// Points that take the colours of the chosen atoms (coloring.h), all of which a path joins that leaves them at no
/// point.
struct AtomPatch {
  double area = 0.0;                 ///< Å², exact
  std::vector<std::uint32_t> atoms;  ///< of Surface::atoms, rising; an atom may have parts of several patches
  std::vector<double> areas;         ///< Å², what each of them has of it
};

/// All of them, the largest first; of equal ones that of the first atom. chosen: one per Surface::atoms. Faces of one
/// re-entrant patch count as joined (atom_shares). Their areas add up to those of the chosen atoms. Needs the surface's
/// faces measured.
std::vector<AtomPatch> atom_patches(const Surface& surface, const std::vector<bool>& chosen);

/// Of the chosen atoms those that have a part of a patch of at least `least` Å², for pictures, which know of each point
/// no more than its atom. An atom may have parts of several patches: a smaller one is taken too, whole, if an atom of
/// it is. Likewise.
std::vector<bool> atoms_of_patches(const Surface& surface, std::vector<bool> chosen, double least);

}  // namespace meniscus
