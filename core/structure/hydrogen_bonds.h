// SPDX-License-Identifier: BSD-3-Clause
// Finds hydrogen bonds by distances and angles, with and without hydrogens in the file.
#pragma once

#include <span>
#include <vector>

#include "core/structure/structure.h"

namespace meniscus {

/// Returns the hydrogen bonds D-H...A between the atoms of two sets, as pairs of donor D and acceptor A. Each pair is
/// there once, in ascending order. one, other: one truth value for each atom; either set may have the donor.
///
/// Donors are N, O and S with hydrogens, and acceptors are O and N with a free electron pair. Where D has hydrogens,
/// H...A is at most 2.5 Å and D-H...A more than 120 degrees (E. N. Baker and R. E. Hubbard, Prog. Biophys. Mol. Biol.
/// 44, 97 (1984)). Where a residue has none, planar nitrogens with two neighbours, as in peptides, get a hydrogen 1.01
/// Å opposite of these. For other donors D...A is at most 3.5 Å, and the angles at D and A to each of their neighbours
/// are more than 90 degrees (the test without hydrogens of I. K. McDonald and J. M. Thornton, J. Mol. Biol. 238, 777
/// (1994)). Donors without hydrogens follow from bonds and their lengths: water, OH (C-O longer than 1.30 Å), and N
/// with a valence left. N that is neither in an amide nor in a base may be both, as in histidine.
///
/// There are no bonds within a residue, across at most three covalent bonds, between models or alternate locations, and
/// to periodic images. Time is O(n) for molecules.
std::vector<Bond> hydrogen_bonds(std::span<const Atom> atoms, const std::vector<bool>& one,
                                 const std::vector<bool>& other);

}  // namespace meniscus
