// SPDX-License-Identifier: BSD-3-Clause
// Exact first derivatives of areas and volumes by the positions of atoms, in closed form.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

struct Surface;

/// One derivative per Surface::atoms; zero for buried atoms.
using Gradient = std::vector<glm::dvec3>;

/// Returns the gradient of the solvent-accessible area, the sum over atoms of weight * area (atom_areas.h), in Å² *
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
