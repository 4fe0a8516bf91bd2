// SPDX-License-Identifier: BSD-3-Clause
// Regions on a sphere bounded by circular arcs: area, first moment, and which loops bound the same region.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "core/surface/primitives.h"

namespace meniscus {

/// One step of a loop on the unit sphere: an arc of the circle dot(axis, u) = height from the point `from` to the point
/// `to`, counter-clockwise about the axis unless the sweep is negative. A sweep of 0 has a sign, too: an arc without
/// length still has a direction, which the corners on both sides of it need.
struct SphereArc {
  glm::dvec3 axis{0.0};
  double height = 0.0;
  glm::dvec3 from{0.0};
  glm::dvec3 to{0.0};
  double sweep = 0.0;
  bool whole = false;  ///< a whole circle without vertices

  bool clockwise() const { return std::signbit(sweep); }
};

/// Returns a half-border as a step on the unit sphere around `center` of radius `radius`. Faces seen from the sphere's
/// inside (concave patches) have their region on the left of the reversed walk.
SphereArc sphere_arc(const Border& border, bool backwards, const glm::dvec3& center, double radius);

/// Writes a loop of a spherical face to `arcs`, as a walk on the unit sphere with the face on its left.
void walk_loop(const Surface& surface, const Loop& loop, const glm::dvec3& center, double radius, bool seen_from_inside,
               std::vector<SphereArc>& arcs);

/// Returns the area of the disc on the left of a closed loop with interior angles of at most pi: 2 pi less its total
/// turning, which is its geodesic curvature plus the exterior angles at its corners (Gauss-Bonnet). The area lies
/// between 0 and 4 pi up to rounding, provided that the loop is closed; see misfit_of().
double area_left_of(std::span<const SphereArc> loop);

/// Returns how far the loop is from closing, relative to its smallest circle: the largest step from the end of an arc
/// to the beginning of the next, over the smaller radius of the two. The turning at that corner is wrong by as many
/// radians. As a rule this is rounding; it is larger where a tie was decided for spheres that differ by more than the
/// circle.
double misfit_of(std::span<const SphereArc> loop);

/// Returns the length of the shortest arc that has ends, in radians; at most 1.
double shortest_of(std::span<const SphereArc> loop);

/// A circle of the unit sphere with a start: height*axis + cos t * x + sin t * y, counter-clockwise about the axis; |x|
/// = |y| = its radius.
struct SphereCircle {
  glm::dvec3 axis;
  double height;
  glm::dvec3 x, y;
};

/// Returns the circle of an arc, turned so that the arc runs counter-clockwise from t = 0 to t = |sweep|.
SphereCircle circle_of(const SphereArc& arc);

/// Returns the integral of (1 - cos theta) d phi along a circle from t = from to t = to; theta and phi are polar
/// coordinates about `pole`. Along the border of a region these integrals add up to the region's area, less 4 pi if the
/// region contains the antipode of the pole. Unlike the turning, the integral needs no tangents, which tiny circles do
/// not have.
double area_swept_from(const glm::dvec3& pole, const SphereCircle& circle, double from, double to);

/// Returns the same integral along closed loops, with the small steps from the end of an arc to the beginning of the
/// next.
double area_swept_from(const glm::dvec3& pole, std::span<const SphereArc> loop);

/// Returns the integral of the unit vector u over the region on the left of the loops: half the sum of integrals of u x
/// du.
glm::dvec3 moment_left_of(std::span<const SphereArc> loop);

/// Returns the contribution of the steps between the arcs of a loop that does not quite close to moment_left_of().
glm::dvec3 moment_of_steps(std::span<const SphereArc> loop);

/// Returns the straight distance from a point of the unit sphere to the loop, positive if the point lies on its left.
/// All interior angles are at most pi, as in area_left_of().
double distance_left_of(const glm::dvec3& point, std::span<const SphereArc> loop);

/// True if `inner`, which may touch the loop but not cross it, lies on the left of it.
bool lies_left_of(std::span<const SphereArc> inner, std::span<const SphereArc> loop);

}  // namespace meniscus
