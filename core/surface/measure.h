// SPDX-License-Identifier: BSD-3-Clause
// Areas and volumes in closed form: of the surface, of each atom, and their derivatives by the positions of atoms.
#pragma once

#include "core/surface/primitives.h"

namespace meniscus {

class ConvexPlanes;

/// The faces whose areas are doubtful.
struct MeasurementDoubts {
  std::vector<std::uint32_t> doubtful;  ///< corners do not fit their circles; measured by a second closed form
  std::vector<std::uint32_t> disputed;  ///< the doubtful faces for which the two closed forms disagree
};

/// Returns the point half-way between the outermost centres, Å. Volumes are measured from it, with least rounding.
glm::dvec3 middle_of(std::span<const Ball> atoms);

/// The contributions of faces to their components, in addition to Face::area.
struct MeasuredFaces {
  std::vector<double>
      flux;  ///< per face: the integral of x·n over it, Å³; a third of it is the face's part of the volume
  MeasurementDoubts doubts;
};

/// Computes Face::area. origin: the point from which the integrals measure x.
MeasuredFaces measure_faces(Surface& surface, const glm::dvec3& origin, const ConvexPlanes& planes);

/// Sorts components into the order of the list: outer ones first, then cavities, each by falling area. Returns the new
/// index of each.
std::vector<std::uint32_t> sort_components(std::vector<Component>& components);

/// Computes Face::area, Component::{area, volume, kind} and Surface::{area, volume}, and sorts the components: outer
/// ones first, then cavities, each by falling area. Areas follow from Gauss-Bonnet, volumes from the divergence
/// theorem. Both are sums of closed forms over borders, so the only error is rounding. Where ties have left a face with
/// corners off its circles, its area is integrated about a pole instead, which needs no tangents.
MeasurementDoubts measure_surface(Surface& surface, const ConvexPlanes& planes);
MeasurementDoubts measure_surface(Surface& surface);  ///< uses the clip planes listed in the surface's tables

/// Returns the tube angles of the contacts with atom[0] and atom[1]. A tube angle is the latitude on the probe,
/// measured from the direction to the axis towards atom[1].
std::array<double, 2> contact_tube_angles(const Surface& surface, const ToroidalPatch& patch);
/// Returns the tube angles between which the patch's n-th face lies, the lower one first.
std::array<double, 2> tube_range(const Surface& surface, const ToroidalPatch& patch, std::uint32_t n);
/// Returns the integrals of 1, of the tube angle's cosine and of its sine over the patch between two tube angles, per
/// radian around the axis, Å².
glm::dvec3 toroidal_moments(const Surface& surface, const ToroidalPatch& patch, double low, double high);
/// Returns the area of the patch between two tube angles, Å².
double toroidal_area(const Surface& surface, const ToroidalPatch& patch, double low, double high);

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

/// Computes the sums of AtomAreas over each of `count` groups of atoms, up to rounding. group_of_atom: the group of
/// each of Surface::atoms, below `count`. Only patches between atoms of different groups are divided, so this takes
/// less time than atom_areas(). Throws as atom_areas() does.
AtomAreas group_areas(const Surface& surface, std::span<const std::uint32_t> group_of_atom, std::uint32_t count);

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

/// One derivative per Surface::atoms; zero for buried atoms.
using Gradient = std::vector<glm::dvec3>;

/// Returns the gradient of the solvent-accessible area, the sum over atoms of weight * area (atom_areas()), in Å² *
/// weight / Å. Empty weights are 1 for all atoms. Only arcs move the borders of accessible patches, so the gradient is
/// a sum over saddle patches (Perrot et al. 1992, equations 10 to 19; Edelsbrunner & Koehl 2003, weighted area
/// theorem). It is continuous wherever no two spheres touch in one point from inside or outside. For a probe of radius
/// 0 the area is that of the balls.
Gradient accessible_area_gradient(const Surface& surface, std::span<const double> weights = {});

/// Returns the gradient of the volume inside the solvent-accessible surface, Å³ / Å: the vector area of the accessible
/// part of each atom's sphere (Edelsbrunner & Koehl 2005, volume derivative theorem).
Gradient accessible_volume_gradient(const Surface& surface);

/// Returns the atoms of the first probe that touches more than three atoms. Empty: there is no such probe, and all
/// derivatives exist.
std::vector<std::uint32_t> tied_atoms(const Surface& surface);

/// Returns the gradient of Surface::volume, Å³ / Å: the integral of the speed with which the surface moves along its
/// normal. A contact patch moves with its atom, a re-entrant patch with its probe, which keeps touching its three
/// atoms, and the slices of a saddle move with the rolling probe. Cusps move, too, but sweep no volume. Throws
/// RequestError, naming tied_atoms, where a probe touches more than three atoms: the three atoms that it will keep
/// touching depend on the motion, so there is no derivative.
Gradient volume_gradient(const Surface& surface);

/// Returns the gradient of Surface::area, Å² / Å: the integral of speed times the sum of principal curvatures, and
/// along each cusp the area that its motion adds to both sides. Throws RequestError as volume_gradient does. For a
/// probe of radius 0 it equals accessible_area_gradient.
Gradient area_gradient(const Surface& surface);

}  // namespace meniscus
