// SPDX-License-Identifier: BSD-3-Clause
// Regions on a sphere bounded by circular arcs: area, first moment, and which loops bound the same region.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "core/surface/primitives.h"

namespace meniscus {

/// One step of a loop on the unit sphere: an arc of the circle dot(axis, u) = height, counter-clockwise about the axis
/// unless the sweep has a negative sign, from the point `from` to the point `to`. A sweep of 0 has a sign, too: an arc
/// without length still has a direction, which the corners on both sides of it need.
struct SphereArc {
  glm::dvec3 axis{0.0};
  double height = 0.0;
  glm::dvec3 from{0.0};
  glm::dvec3 to{0.0};
  double sweep = 0.0;
  bool whole = false;  ///< a whole circle without vertices

  bool clockwise() const { return std::signbit(sweep); }
};

/// A half-border as a step on the unit sphere around `center` of radius `radius`. Faces seen from the sphere's inside
/// (concave patches) have their region on the left of the reversed walk.
SphereArc sphere_arc(const Border& border, bool backwards, const glm::dvec3& center, double radius);

/// A loop of a spherical face as a walk on the unit sphere that has the face on its left; `arcs` is overwritten.
void walk_loop(const Surface& surface, const Loop& loop, const glm::dvec3& center, double radius, bool seen_from_inside,
               std::vector<SphereArc>& arcs);

/// Area of the disc on the left of a closed loop, all interior angles at most pi: 2 pi less its total turning, which is
/// its geodesic curvature and the exterior angles at its corners (Gauss-Bonnet). From 0 to 4 pi but for rounding,
/// provided the loop is closed, see misfit_of().
double area_left_of(std::span<const SphereArc> loop);

/// How far the loop is from being closed, relative to its smallest circle: the largest step from the end of an arc to
/// the beginning of the next, over the smaller radius of the two. The turning at that corner is wrong by so many
/// radians: rounding, as a rule, but anything where a tie was decided for spheres that differ by more than the circle.
double misfit_of(std::span<const SphereArc> loop);

/// Length of the shortest arc that has ends, radian; at most 1.
double shortest_of(std::span<const SphereArc> loop);

/// A circle of the unit sphere, or the beginning of one: height*axis + cos t * x + sin t * y, counter-clockwise about
/// the axis; |x| = |y| = its radius.
struct SphereCircle {
  glm::dvec3 axis;
  double height;
  glm::dvec3 x, y;
};

/// The circle of an arc, so turned that the arc runs counter-clockwise from t = 0 to t = |sweep|.
SphereCircle circle_of(const SphereArc& arc);

/// Integral of (1 - cos theta) d phi along a circle from t = from to t = to; theta and phi are polar coordinates about
/// `pole`. Along the border of a region these integrals add up to the region's area, less 4 pi if the region holds the
/// antipode of the pole. Unlike the turning it needs no tangents, which tiny circles do not have.
double area_swept_from(const glm::dvec3& pole, const SphereCircle& circle, double from, double to);

/// The same along closed loops; small steps from the end of an arc to the beginning of the next belong to them.
double area_swept_from(const glm::dvec3& pole, std::span<const SphereArc> loop);

/// Integral of the unit vector u over the region on the left of the loops: 1/2 of the sum of integrals of u x du.
glm::dvec3 moment_left_of(std::span<const SphereArc> loop);

/// What the steps between the arcs of a loop that does not quite close add to that.
glm::dvec3 moment_of_steps(std::span<const SphereArc> loop);

/// The straight distance from a point of the unit sphere to the loop; positive if the point lies on the left of it.
/// All interior angles at most pi, as in area_left_of().
double distance_left_of(const glm::dvec3& point, std::span<const SphereArc> loop);

/// True if `inner`, which may touch the loop but not cross it, lies on the left of it.
bool lies_left_of(std::span<const SphereArc> inner, std::span<const SphereArc> loop);

}  // namespace meniscus
