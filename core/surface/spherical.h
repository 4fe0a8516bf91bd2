// SPDX-License-Identifier: BSD-3-Clause
// Regions on a sphere bounded by circular arcs: area, first moment, and which loops bound the same region.
#pragma once

#include <span>

#include "core/surface/primitives.h"

namespace meniscus {

/// One step of a loop on the unit sphere: an arc of the circle dot(axis, u) = height, counter-clockwise about the axis
/// when sweep > 0, clockwise when sweep < 0, from the point `from` to the point `to`.
struct SphereArc {
  glm::dvec3 axis{0.0};
  double height = 0.0;
  glm::dvec3 from{0.0};
  glm::dvec3 to{0.0};
  double sweep = 0.0;
  bool whole = false;  ///< a whole circle without vertices
};

/// A half-border as a step on the unit sphere around `center` of radius `radius`. Faces seen from the sphere's inside
/// (concave patches) have their region on the left of the reversed walk.
SphereArc sphere_arc(const Border& border, bool backwards, const glm::dvec3& center, double radius);

/// Area of the disc on the left of a closed loop, in (0, 4 pi) (Gauss-Bonnet), all interior angles below pi.
double area_left_of(std::span<const SphereArc> loop);

/// Integral of the unit vector u over the region on the left of the loops: 1/2 of the sum of integrals of u x du.
glm::dvec3 moment_left_of(std::span<const SphereArc> loop);

/// The straight distance from a point of the unit sphere to the loop; positive if the point lies on the left of it.
/// All interior angles at most pi, as in area_left_of().
double distance_left_of(const glm::dvec3& point, std::span<const SphereArc> loop);

/// True if `inner`, which may touch the loop but not cross it, lies on the left of it.
bool lies_left_of(std::span<const SphereArc> inner, std::span<const SphereArc> loop);

}  // namespace meniscus
