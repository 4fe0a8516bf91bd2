// SPDX-License-Identifier: BSD-3-Clause
// The area of the surface that belongs to each atom, in closed form.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace meniscus {

struct ConcavePatch;
struct Face;
struct Surface;

/// Areas in Å², one per Surface::atoms; 0 for buried atoms.
struct AtomAreas {
  /// The area of the points that take the atom's colour (coloring.h): its contact patch, and the parts of adjacent
  /// saddle and re-entrant patches that are nearest to its contact. The sum is Surface::area up to rounding.
  std::vector<double> surface;
  /// The solvent-accessible area: the part of the sphere of radius r + probe radius where the probe's centre can be.
  std::vector<double> accessible;
};

/// Computes the areas of atoms. The surface's faces must have been measured. Throws OpenSurfaceError if the areas do
/// not add up to the surface's, or if one is negative, by more than a millionth. Runs on all cores that TBB may use;
/// the result does not depend on their number.
AtomAreas atom_areas(const Surface& surface);

/// Computes the areas of atoms of a surface that may be unsound in places. Throws nothing: `contradicted` receives the
/// atoms of re-entrant patches whose shares do not add up to their faces.
AtomAreas atom_areas(const Surface& surface, std::vector<std::uint32_t>& contradicted);

/// Computes the areas of atoms within each of `count` groups of faces, for surfaces with closed parts of separate
/// interest. group_of_face: the group of each of Surface::faces, below `count`; the faces of one saddle or re-entrant
/// patch share a group.
std::vector<AtomAreas> atom_areas(const Surface& surface, std::span<const std::uint32_t> group_of_face,
                                  std::uint32_t count);

/// A part of the surface that belongs to one atom: a face of its contact patch, half of a saddle's face, or the atom's
/// part of a re-entrant patch.
struct AtomShare {
  std::uint32_t atom = 0;  ///< index into Surface::atoms
  double area = 0.0;       ///< Å²
};

/// All shares of a surface, and the pairs of them that meet.
struct AtomShares {
  std::vector<AtomShare> shares;
  std::vector<std::array<std::uint32_t, 2>> meetings;  ///< pairs of shares that have a line in common, in any order
};

/// Divides the surface into shares. The shares of each atom add up to AtomAreas::surface. A re-entrant patch that
/// others cut into several faces has one share for each atom, as if its faces were connected. The surface's faces must
/// have been measured.
AtomShares atom_shares(const Surface& surface);

/// Returns the solvent-accessible area in Å²: the sum of AtomAreas::accessible, at almost no cost.
double accessible_area(const Surface& surface);

/// Returns the area in Å² that the probe's centre sweeps on the atom's SAS sphere while the probe touches this face of
/// a contact patch.
double accessible_area(const Surface& surface, const Face& face);

/// Returns the area of a re-entrant patch in Å² as the sum of the shares of the atoms that it touches. The shares come
/// from integrals along the patch's planes and its borders, so the sum is the area of the patch's faces only if both
/// describe one figure.
double divided_area(const Surface& surface, const ConcavePatch& patch);

}  // namespace meniscus
