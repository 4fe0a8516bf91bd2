// SPDX-License-Identifier: BSD-3-Clause
// Helices and strands: as a file lists them, else by the hydrogen bonds of the backbone.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {

enum class SecondaryStructure : std::uint8_t;
struct Atom;

/// A stretch of residues that a file calls helix or strand; both ends belong to it.
struct SecondaryRange {
  using Residue = std::pair<std::int32_t, char>;  ///< number and insertion code
  std::string chain;
  Residue first, last;
  SecondaryStructure kind;
};

/// Sets Atom::secondary of the polymers to what the ranges say, `coil` outside of them; does nothing where no range has
/// an atom.
void mark_secondary_structure(std::vector<Atom>& atoms, std::span<const SecondaryRange> ranges);

/// Per atom what its residue belongs to, model by model as if each were alone. If any atom of a model has an
/// Atom::secondary, that of all of them; else by W. Kabsch and C. Sander, Biopolymers 22, 2577 (1983): helices of three
/// kinds (alpha, 3-10, pi) and ladders of at least two bridges, from N, CA, C and O of each residue. Residues without
/// all four, and lone bridges, are coil. Atoms of a residue are together, residues in the order of their chains. O(n)
/// for molecules.
std::vector<SecondaryStructure> secondary_structure(std::span<const Atom> atoms);

/// Sets Atom::secondary to that.
void assign_secondary_structure(std::vector<Atom>& atoms);

}  // namespace meniscus
