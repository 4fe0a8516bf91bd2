// SPDX-License-Identifier: BSD-3-Clause
// Least-squares superposition of the same atoms at two positions, or of two molecules by their sequences.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/rigid_motion.h"

namespace meniscus {

struct Atom;

/// Returns the rotation and translation of `positions` that minimizes the sum of squared distances between its `atoms`
/// and the same atoms of `reference` (D. L. Theobald, Acta Cryst. A 61, 478, 2005). Mirror images are excluded. There
/// must be at least three atoms. If they are in a line, the rotation about that line is arbitrary.
RigidMotion superposition(std::span<const glm::dvec3> reference, std::span<const glm::dvec3> positions,
                          std::span<const std::uint32_t> atoms);

/// Two corresponding atoms of two molecules, as places in their lists.
struct AtomPair {
  std::uint32_t reference = 0, moved = 0;
};

/// Returns the motion of `moved` that superposes the pairs, under the conditions above.
Superposition superposition(std::span<const Atom> reference, std::span<const Atom> moved,
                            std::span<const AtomPair> pairs);

/// Returns the corresponding atoms of two molecules. Chains are aligned by their residues (S. B. Needleman and C. D.
/// Wunsch 1970; BLOSUM62 for amino acids, S. Henikoff and J. G. Henikoff 1992; gaps cost 10 + 1 per residue). The two
/// chains with the best score are paired. Then each other chain is paired with one of nearly its best score, the one
/// that is nearest after superposition. There may be several first pairs of nearly the best score, as with copies of
/// one chain. In that case the result with the most atoms, and then with the least RMSD, is returned.
/// In aligned residues, atoms with the same name correspond. of_reference, of_moved: true for each atom that takes
/// part. The result is empty if there are fewer than three pairs. Time is O(residues of one times residues of the
/// other).
std::vector<AtomPair> corresponding_atoms(std::span<const Atom> reference, const std::vector<bool>& of_reference,
                                          std::span<const Atom> moved, const std::vector<bool>& of_moved);

}  // namespace meniscus
