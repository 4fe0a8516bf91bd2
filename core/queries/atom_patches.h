// SPDX-License-Identifier: BSD-3-Clause
// Finds the contiguous areas of a surface that belong to some of its atoms, such as hydrophobic or charged patches.
#pragma once

#include <cstdint>
#include <vector>

namespace meniscus {

struct Surface;

/// A maximal connected set of points that take the colours of the chosen atoms (coloring.h).
struct AtomPatch {
  double area = 0.0;  ///< Å², exact
  /// Indices into Surface::atoms, ascending; an atom may have parts of several patches.
  std::vector<std::uint32_t> atoms;
  std::vector<double> areas;  ///< Å², the part of the patch that each of these atoms has
};

/// Returns all patches, the largest first; equally large ones in the order of their first atoms. `chosen` has one entry
/// for each of Surface::atoms. Faces of one re-entrant patch count as joined (atom_shares). The areas of the patches
/// add up to those of the chosen atoms. The faces of the surface must be measured.
std::vector<AtomPatch> atom_patches(const Surface& surface, const std::vector<bool>& chosen);

/// Returns true for the chosen atoms that have a part of a patch of at least `least` Å². It is for pictures, which know
/// only the atom of each point: an atom may have parts of several patches, and a smaller patch is taken, too, as a
/// whole, if one of its atoms is. The conditions of atom_patches() apply.
std::vector<bool> atoms_of_patches(const Surface& surface, std::vector<bool> chosen, double least);

}  // namespace meniscus
