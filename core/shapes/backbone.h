// SPDX-License-Identifier: BSD-3-Clause
// The backbone of proteins and nucleic acids as a smooth swept body: ribbons, arrows and tubes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/shapes/shapes.h"

namespace meniscus {

/// Å: half the thickness of all, and of tubes half the width.
inline constexpr double kTubeRadius = 0.3;

/// A closed mesh for each unbroken piece of the selected CA (or, of nucleotides, P, else C4'; of Martini, BB) of at
/// least two residues, and a sphere for each that is alone: helices are ribbons as wide as 8 radii, along the direction
/// of the peptide planes (M. Carson and C. E. Bugg, J. Mol. Graph. 4, 121, 1986; from O, where it is there), strands
/// are 7 wide and end in arrows, all else is a tube. The middle line is a Catmull-Rom spline through these atoms,
/// smoothed in strands. Kinds are those of Atom::secondary, or of secondary_structure() of these atoms. Pieces end
/// where chain, model or copy change and where neighbours are farther apart than 4.5 Å (CA) or 8.5 Å (P). atom of a
/// vertex: that of the nearer residue. radius: Å, > 0.
Shapes backbone(const Structure& structure, const std::vector<bool>& selected, double radius = kTubeRadius);

/// A point of the middle line of backbone().
struct MiddlePoint {
  glm::dvec3 position;  ///< Å
  std::uint32_t atom;   ///< into Structure::atoms: that of the nearer residue
};

/// Along all nucleotides of the structure, piece by piece: eight from one residue to the next.
std::vector<MiddlePoint> nucleic_middle_lines(const Structure& structure);

/// The atoms as their file has them, copy by copy: places in `atoms`.
std::vector<std::uint32_t> file_order(std::span<const Atom> atoms);

}  // namespace meniscus
