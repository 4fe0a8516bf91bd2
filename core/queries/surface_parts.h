// SPDX-License-Identifier: BSD-3-Clause
// Parts and points of a surface: closed components as a surface of their own, the contiguous areas of chosen atoms, and
// the curvature at a point.
#pragma once

#include "core/surface/primitives.h"

namespace meniscus {

/// A part of a surface with only the atoms that it touches.
struct SurfacePart {
  Surface surface;
  std::vector<std::uint32_t> atom;  ///< per surface.atoms: its index in the whole surface
};

/// Returns the components c with keep[c] as a closed surface with tables of its own. Its faces, borders and measures
/// are those of the whole surface; patches without a remaining face are dropped. A patch may have faces that stay and
/// faces that go, for example on an atom between the outside and a cavity. Planes are then added that separate them,
/// and if no plane separates some of the faces that stay from others, each gets a patch of its own. Throws
/// CapacityError if a face cannot be separated from another one of its patch by a plane.
SurfacePart part_of(const Surface& surface, const std::vector<bool>& keep);

/// Returns true for the components that the outside reaches: all but cavities and what lies inside of a cavity. An
/// island such as an atom that floats in a cage is not reached, although by itself it is an outer component.
std::vector<bool> reached_from_outside(const Surface& surface);

/// Returns how often a component winds around a point that is not on it, seen from its solvent's side: 1 around a point
/// in the solid that it encloses, -1 around a point in a cavity that it encloses, 0 otherwise. The point (Å) is in no
/// ball that the component touches unless the component encloses that ball, and in no probe that touches it.
int winding_number(const Surface& surface, std::uint32_t component, const glm::dvec3& point);

/// A maximal connected set of points that take the colours of the chosen atoms (coloring.h).
struct AtomPatch {
  double area = 0.0;  ///< Å², exact
  /// Indices into Surface::atoms, ascending; an atom may have parts of several patches.
  std::vector<std::uint32_t> atoms;
  std::vector<double> areas;  ///< Å², the part of the patch that each of these atoms has
};

/// Returns all patches, the largest first; equally large ones in the order of their first atoms. `chosen` has one entry
/// for each of Surface::atoms. Faces of one re-entrant patch count as joined (atom_shares). The areas of the patches
/// add up to the areas of the chosen atoms. The faces of the surface must be measured.
std::vector<AtomPatch> atom_patches(const Surface& surface, const std::vector<bool>& chosen);

/// Returns true for the chosen atoms that have a part of a patch of at least `least` Å². It is for pictures, which know
/// only the atom of each point: an atom may have parts of several patches, and a smaller patch is taken, too, as a
/// whole, if one of its atoms is. The conditions of atom_patches() apply.
std::vector<bool> atoms_of_patches(const Surface& surface, std::vector<bool> chosen, double least);

/// The curvature by the principal curvatures k1, k2 with the normal towards the solvent, positive on bulges.
struct Curvature {
  double mean = 0.0;      ///< (k1 + k2) / 2, 1/Å
  double gaussian = 0.0;  ///< k1 k2, 1/Å²
};

/// The distance (Å) from the axis of a spindle torus below which curvatures are those at this distance: the second one
/// grows without bound towards the tip.
inline constexpr double kCurvatureCore = 0.001;

/// Returns the curvature at a point (Å) of a face. On an atom of radius r both principal curvatures are 1/r, on a fixed
/// probe of radius p -1/p. On a torus of major radius R, at the angle t of its tube from the axis, they are -1/p and
/// cos t / (R - p cos t) (do Carmo, "Differential geometry of curves and surfaces", 1976, section 3.3, example 5).
Curvature curvature(const Surface& surface, std::uint32_t face, const glm::dvec3& point);

/// True if some place of the probe is nearer to the point (Å) than the probe's radius, or is the point itself. The
/// nearest such place lies on one SAS sphere, on two, or on three, and all of these are tried. A point within 1e-6 Å of
/// the surface may count as not in the solvent. So may a point in reach of more than 200 balls, as large probes have
/// them, if its nearest place is a fixed probe.
bool in_solvent(std::span<const Ball> atoms, double probe_radius, const glm::dvec3& point);

}  // namespace meniscus
