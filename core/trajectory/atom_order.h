// SPDX-License-Identifier: BSD-3-Clause
// Checks whether the atoms of a trajectory are in the same order as in the structure file.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/trajectory/trajectory.h"

namespace meniscus {

/// The frame that is compared, and the files that it belongs to.
struct ComparedFrame {
  const std::string& file;        ///< the structure file
  bool file_has_positions;        ///< true if the structure file has coordinates, in which bonds are found by distance
  const std::string& trajectory;  ///< the trajectory file
  std::uint64_t number;
};

/// Checks that bonds of the structure file, in residues with an atom in `used`, are short enough in the frame, which
/// has as many atoms. These bonds are the listed ones and, if the file has coordinates, the bonds of standard residues
/// that are short enough there. A bond is too long if it exceeds the sum of the covalent radii (B. Cordero et al.,
/// Dalton Trans. 2008, 2832) by three tenths. Distances are to the nearest image in the periodic box. In a frame
/// without a box, a bond that spans half of the frame's extent and 8 Å may be a jump across a box and does not count.
/// Metals, sites without element and bonds between hydrogens are ignored. Files without bonds (XYZ, beads) always pass,
/// because nothing is known about their order. Molecules or residues of the same kind may be exchanged without notice.
/// Throws InputError if three bonds and a third of the bonds of a residue, or three bonds and a tenth of all, are too
/// long.
void check_atom_order(const Topology& topology, std::span<const Atom> used, const Frame& frame,
                      const ComparedFrame& compared);

}  // namespace meniscus
