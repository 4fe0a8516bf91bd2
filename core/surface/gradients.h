// SPDX-License-Identifier: BSD-3-Clause
// How areas and volumes change when atoms move: exact first derivatives by their positions, in closed form.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

struct Surface;

/// A derivative by the position of each of Surface::atoms; zero for buried atoms.
using Gradient = std::vector<glm::dvec3>;

/// Of the solvent-accessible area, the sum over atoms of weight * area (atom_areas.h), Å² * weight / Å; empty weights:
/// 1 for all. Only arcs move the borders of accessible patches, so it is a sum over saddle patches (Perrot et al. 1992,
/// equations 10 to 19; Edelsbrunner & Koehl 2003, weighted area theorem). It is continuous wherever no two spheres
/// touch in one point from inside or outside. A surface with a probe of radius 0 has the area of the balls themselves
/// here.
Gradient accessible_area_gradient(const Surface& surface, std::span<const double> weights = {});

/// Of the volume inside of the solvent-accessible surface, Å³ / Å: of each atom's sphere the vector area of what is
/// accessible (Edelsbrunner & Koehl 2005, volume derivative theorem).
Gradient accessible_volume_gradient(const Surface& surface);

/// The atoms of the first probe that touches more than three of them; empty: there is none, and all derivatives exist.
std::vector<std::uint32_t> tied_atoms(const Surface& surface);

/// Of Surface::volume, Å³ / Å: the integral of the speed with which the surface moves along its normal. A contact patch
/// goes with its atom, a re-entrant one with its probe, which keeps touching its three atoms, and the slices of a
/// saddle with the rolling probe. Cusps move, too, but what they sweep has no volume.
/// Throws RequestError, naming tied_atoms, where a probe touches more than three atoms: which three of them it will go
/// on touching depends on how they move, so there is no derivative.
Gradient volume_gradient(const Surface& surface);

/// Of Surface::area, Å² / Å: the integral of speed times the sum of principal curvatures, and along each cusp what its
/// motion adds to both sides. Throws as volume_gradient does. A surface with a probe of radius 0 has that of
/// accessible_area_gradient.
Gradient area_gradient(const Surface& surface);

}  // namespace meniscus
