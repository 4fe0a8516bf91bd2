// SPDX-License-Identifier: BSD-3-Clause
// Finds the atoms of a class that a selection names: protein, backbone, water, ...
#pragma once

#include <span>
#include <vector>

#include "core/structure/selection/selection_steps.h"

namespace meniscus {

struct Atom;

/// Returns for each atom whether it belongs to the class. Protein and nucleic are residues with a known name. Other
/// residues of polymers are classified by their atoms: N, CA and C make an amino acid, C4' or C4* a nucleotide.
std::vector<bool> atoms_with(AtomFlag flag, std::span<const Atom> atoms);

}  // namespace meniscus
