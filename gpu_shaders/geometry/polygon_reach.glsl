// SPDX-License-Identifier: BSD-3-Clause
// Computes the extent of a spherical polygon in a direction, which determines if one fixed probe cuts the patch of
// another.
//
// This file is written in the common subset of GLSL and C++ with GLM (circle.glsl).
#ifndef MENISCUS_GEOMETRY_POLYGON_REACH_GLSL
#define MENISCUS_GEOMETRY_POLYGON_REACH_GLSL

// Returns the largest dot product of the unit vector d with the points of one side, the great-circle arc from a to b.
// The point b belongs to the next side. outside: positive if d lies beyond the side. If it is positive for no side, d
// is in the polygon, and the largest dot product is 1.
GEOMETRY real reach_of_side(real3 a, real3 b, real3 d, GEOMETRY_OUT(real) outside) {
  real3 normal = cross(a, b);
  outside = dot(normal, d);
  real best = dot(d, a);
  if (outside > real(0) && dot(cross(normal, a), d) > real(0) && dot(cross(b, normal), d) > real(0)) {
    real square = real(1) - outside * outside / dot(normal, normal);
    real nearest = square > real(0) ? sqrt(square) : real(0);
    if (nearest > best) best = nearest;
  }
  return best;
}

// The extent of a polygon's sides so far in a direction.
struct PolygonReach {
  real farthest;      // largest dot product of the direction with points of the sides
  real most_outside;  // largest value of `outside`; positive if the direction is not in the polygon
};

GEOMETRY PolygonReach no_reach() {
  PolygonReach reach;
  reach.farthest = real(-1);
  reach.most_outside = real(-1);
  return reach;
}

GEOMETRY void add_side(GEOMETRY_INOUT(PolygonReach) reach, real3 a, real3 b, real3 d) {
  real outside;
  reach.farthest = max(reach.farthest, reach_of_side(a, b, d, outside));
  reach.most_outside = max(reach.most_outside, outside);
}

// Returns the largest distance between a probe and another one in this direction for which their bisector, at half the
// distance, cuts the polygon.
GEOMETRY real cut_reach(PolygonReach reach, real probe_radius) {
  return (reach.most_outside <= real(0) ? real(1) : reach.farthest) * real(2) * probe_radius;
}

// True if the bisector of two probes at this distance cuts the polygon, or in doubt. An unnecessary bisector is
// harmless: every bisector is valid (theorem 1.3), but it may cut nothing.
GEOMETRY bool reaches_bisector(PolygonReach reach, real probe_radius, real distance) {
  return cut_reach(reach, probe_radius) >= distance * (real(1) - real(1) / (real(1000000) * real(1000000)));
}

#endif
