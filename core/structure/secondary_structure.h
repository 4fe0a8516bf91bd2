// SPDX-License-Identifier: BSD-3-Clause
// Secondary structure: helices and strands as listed in a file, or else by the hydrogen bonds of the backbone.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {

enum class SecondaryStructure : std::uint8_t;
struct Atom;

/// A range of residues that a file lists as helix or strand. Both ends are included.
struct SecondaryRange {
  using Residue = std::pair<std::int32_t, char>;  ///< residue number and insertion code
  std::string chain;
  Residue first, last;
  SecondaryStructure kind;
};

/// Sets Atom::secondary of all polymer atoms to the kind of their range. Other atoms become `coil`. Nothing is changed
/// if no range contains an atom.
void mark_secondary_structure(std::vector<Atom>& atoms, std::span<const SecondaryRange> ranges);

/// Returns the secondary structure of each atom's residue. Models are independent of each other. If any atom of a model
/// has an Atom::secondary, the values of its atoms are returned. Otherwise it is computed as by W. Kabsch and C.
/// Sander, Biopolymers 22, 2577 (1983): three kinds of helices (alpha, 3-10, pi) and ladders of at least two bridges,
/// from N, CA, C and O of each residue. Residues without all four of them, and single bridges, are coil. Atoms of a
/// residue must be together, and residues in the order of their chains. Time is O(n) for molecules.
std::vector<SecondaryStructure> secondary_structure(std::span<const Atom> atoms);

/// Sets Atom::secondary of each atom to the result of secondary_structure().
void assign_secondary_structure(std::vector<Atom>& atoms);

}  // namespace meniscus
