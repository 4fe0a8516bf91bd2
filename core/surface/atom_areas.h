// SPDX-License-Identifier: BSD-3-Clause
// How much of the surface belongs to each atom, in closed form.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace meniscus {

struct ConcavePatch;
struct Face;
struct Surface;

/// Å², one per Surface::atoms; 0 for buried atoms.
struct AtomAreas {
  /// Area of the points that take the atom's colour (coloring.h): its contact patch, and the parts of the saddle and
  /// re-entrant patches around it whose nearest contact it is. Sums to Surface::area but for rounding.
  std::vector<double> surface;
  /// Solvent-accessible area: of the sphere of radius r + probe radius where the probe's centre can be.
  std::vector<double> accessible;
};

/// Needs the surface's faces measured. Throws OpenSurfaceError if the areas do not add up to the surface's, or one is
/// negative, by more than a millionth. Runs on all cores TBB may use; the result does not depend on their number.
AtomAreas atom_areas(const Surface& surface);

/// The same of a surface that may not be sound all over. Nothing is thrown: `contradicted` gets the atoms of re-entrant
/// patches whose shares do not add up to their faces.
AtomAreas atom_areas(const Surface& surface, std::vector<std::uint32_t>& contradicted);

/// The same of each of `count` groups of faces, for surfaces whose closed parts are of interest by themselves.
/// group_of_face: below `count`, one per Surface::faces; the faces of one saddle or re-entrant patch share a group.
std::vector<AtomAreas> atom_areas(const Surface& surface, std::span<const std::uint32_t> group_of_face,
                                  std::uint32_t count);

/// A part of the surface that belongs to one atom: a face of its contact patch, a half of a saddle's face, or what it
/// has of a re-entrant patch.
struct AtomShare {
  std::uint32_t atom = 0;  ///< of Surface::atoms
  double area = 0.0;       ///< Å²
};

/// All parts, and which of them meet.
struct AtomShares {
  std::vector<AtomShare> shares;
  std::vector<std::array<std::uint32_t, 2>> meetings;  ///< of two shares that have a line in common, in any order
};

/// Those of each atom add up to AtomAreas::surface. A re-entrant patch that others cut into several faces has one share
/// for each atom, as if its faces were connected. Needs the surface's faces measured.
AtomShares atom_shares(const Surface& surface);

/// Å²: the sum of AtomAreas::accessible alone, which takes next to no time.
double accessible_area(const Surface& surface);

/// Å²: what the probe's centre reaches of the atom's grown sphere while the probe touches this face of a contact patch.
double accessible_area(const Surface& surface, const Face& face);

/// Å²: the sum of what the atoms that a re-entrant patch touches get of it. It comes from integrals along the patch's
/// planes as well as its borders, so it is the area of the patch's faces only if both describe one figure.
double divided_area(const Surface& surface, const ConcavePatch& patch);

}  // namespace meniscus
