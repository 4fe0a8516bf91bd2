// SPDX-License-Identifier: BSD-3-Clause
// Places of selected residues: groups of them that are far apart, such as the ligands of several pockets.
#pragma once

#include <span>
#include <vector>

#include "core/structure/structure.h"

namespace meniscus {

/// The widest gap between two residues of one place, Å. Pockets are about as wide.
inline constexpr double kWidestGap = 10.0;

/// Returns the selected atoms of the first residue in the order of the file, and of the residues that gaps of at most
/// kWidestGap between selected atoms join to it.
std::vector<bool> first_place(std::span<const Atom> atoms, const std::vector<bool>& selected);

}  // namespace meniscus
