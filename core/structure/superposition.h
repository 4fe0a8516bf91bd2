// SPDX-License-Identifier: BSD-3-Clause
// Least-squares superposition: of the same atoms in two places, or of two molecules by their sequences.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/math/rigid_motion.h"

namespace meniscus {

struct Atom;

/// The rotation and translation of `positions` that makes the sum of squared distances of its `atoms` to those of
/// `reference` least (D. L. Theobald, Acta Cryst. A 61, 478, 2005). No mirror image. At least three atoms not in a
/// line, else the rotation about the line is any.
RigidMotion superposition(std::span<const glm::dvec3> reference, std::span<const glm::dvec3> positions,
                          std::span<const std::uint32_t> atoms);

/// An atom of one molecule and the one that takes its place in another, as places in their lists.
struct AtomPair {
  std::uint32_t reference = 0, moved = 0;
};

/// The motion of `moved` that brings the pairs together. Conditions as above.
Superposition superposition(std::span<const Atom> reference, std::span<const Atom> moved,
                            std::span<const AtomPair> pairs);

/// Which atoms of two molecules correspond. Chains are aligned by their residues (Needleman & Wunsch 1970; BLOSUM62 for
/// amino acids, Henikoff & Henikoff 1992; gaps cost 10 + 1 a residue). The two that score best are paired, then each
/// other chain with the one of nearly its best score that lies nearest after superposition; of several ways to begin,
/// as with copies of one chain, the one of most atoms and then of the least RMSD counts. In aligned residues atoms of
/// the same name correspond. of_reference, of_moved: per atom, whether it counts. Nothing without three pairs.
/// O(residues of one times residues of the other).
std::vector<AtomPair> corresponding_atoms(std::span<const Atom> reference, const std::vector<bool>& of_reference,
                                          std::span<const Atom> moved, const std::vector<bool>& of_moved);

}  // namespace meniscus
