// SPDX-License-Identifier: BSD-3-Clause
// Which residues of a file are links of a chain, by their bonds and not by their names.
#pragma once

#include <span>
#include <vector>

#include "core/structure/structure.h"

namespace meniscus {

/// For each residue (Atom::residue): does a peptide bond, C to N of two residues with CA or caps of chains, or a
/// phosphodiester, O3' to P of two residues with C4', join it to another residue of its model? By distance, 1.0 to
/// 2.2 Å (bonds are 1.33 and 1.6 Å long, strangers never nearer than 2.5 Å), or by `bonds`, for topologies without
/// coordinates; atoms at the origin count as such. O(n) for molecules.
std::vector<bool> linked_residues(std::span<const Atom> atoms, std::span<const Bond> bonds);

}  // namespace meniscus
