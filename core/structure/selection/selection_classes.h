// SPDX-License-Identifier: BSD-3-Clause
// Answers the questions of a selection about the kind of an atom: protein, backbone, water, ...
#pragma once

#include <span>
#include <vector>

#include "core/structure/selection/selection_steps.h"

namespace meniscus {

struct Atom;

/// One truth value an atom. Protein and nucleic are residues with a known name; other residues of polymers count by
/// their atoms: N, CA and C make an amino acid, C4' or C4* a nucleotide.
std::vector<bool> atoms_with(AtomFlag flag, std::span<const Atom> atoms);

}  // namespace meniscus
