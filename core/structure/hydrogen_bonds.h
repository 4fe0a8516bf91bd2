// SPDX-License-Identifier: BSD-3-Clause
// Finds the hydrogen bonds and the closest atoms of two sets.
#pragma once

#include "core/structure/structure.h"

namespace meniscus {

/// Returns the hydrogen bonds D-H...A between two sets of atoms, as pairs of donor D and acceptor A in ascending order.
/// Each pair is there once; both may be in either set. one, other: one truth value for each atom.
///
/// D is N, O or S with a hydrogen, and A is O, or N with a free electron pair. Where a residue has hydrogens, H...A is
/// at most 2.5 Å and D-H...A more than 120 degrees (E. N. Baker and R. E. Hubbard, Prog. Biophys. Mol. Biol. 44, 97
/// (1984)). Where it has none, planar nitrogens with two neighbours, as in peptides, get a hydrogen 1.01 Å opposite of
/// them. For other donors D...A is at most 3.5 Å, and the angles at D and A to each of their neighbours are more than
/// 90 degrees (I. K. McDonald and J. M. Thornton, J. Mol. Biol. 238, 777 (1994)). These donors are water, OH (C-O is
/// longer than 1.30 Å), and N except for nitriles, planar N with three neighbours, and N1, N3 and N7 of bases without
/// hydrogen. N with two neighbours that is neither in an amide nor in a base may be both, as in histidine.
///
/// There are no bonds within a residue, across at most three covalent bonds, between alternate locations or models of
/// one file, and to periodic images. Time is O(n) for molecules.
std::vector<Bond> hydrogen_bonds(const Structure& structure, const std::vector<bool>& one,
                                 const std::vector<bool>& other);

/// Returns the two different atoms, one of each set, with the smallest distance; of equal ones the first in ascending
/// order; nothing if there are no such atoms. one, other: one truth value for each atom.
std::optional<Bond> closest_pair(std::span<const Atom> atoms, const std::vector<bool>& one,
                                 const std::vector<bool>& other);

}  // namespace meniscus
