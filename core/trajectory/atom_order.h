// SPDX-License-Identifier: BSD-3-Clause
// Checks whether the atoms of a trajectory are in the order of the file that names them.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/trajectory/trajectory.h"

namespace meniscus {

struct Atom;
struct Topology;

/// Which frame of which files is compared.
struct ComparedFrame {
  const std::string& file;        ///< that names the atoms
  bool file_has_positions;        ///< of its own, with which bonds can be compared
  const std::string& trajectory;  ///< that places them
  std::uint64_t number;
};

/// Compares bonds of the file, in residues with an atom in `used`, with distances in the frame, which has as many
/// atoms: bonds that it lists, and, if it has coordinates, those of standard residues that are bonds there. Too long is
/// what exceeds the covalent radii (B. Cordero et al., Dalton Trans. 2008, 2832) by three tenths; distances are to the
/// nearest image in the periodic box, and where the frame has none, what spans half of its extent, and 8 Å, may be a
/// jump over a box and does not count. Metals, sites without element and bonds between hydrogens are passed over, and
/// so are files without bonds (XYZ, beads): nothing is known about their order. What is alike, molecules or residues,
/// may stand for each other. Throws InputError if three bonds and a third of those of a residue, or a tenth of all, are
/// too long.
void check_atom_order(const Topology& topology, std::span<const Atom> used, const Frame& frame,
                      const ComparedFrame& compared);

}  // namespace meniscus
