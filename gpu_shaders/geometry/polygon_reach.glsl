// SPDX-License-Identifier: BSD-3-Clause
// How far a spherical polygon reaches in a direction: what decides whether one fixed probe cuts another's patch.
//
// Written in the common subset of GLSL and C++ with GLM, see circle.glsl.
#ifndef MENISCUS_GEOMETRY_POLYGON_REACH_GLSL
#define MENISCUS_GEOMETRY_POLYGON_REACH_GLSL

// Largest dot product of the unit vector d with the points of one side, the great-circle arc from a to b; b itself counts
// with the next side. outside: positive if d lies beyond the side; if it is for no side, d is in the polygon and the
// largest dot product of all is 1.
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

// What a polygon's sides say so far of a direction.
struct PolygonReach {
  real farthest;      // largest dot product of all
  real most_outside;  // of all sides; positive if the direction is not in the polygon
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

// How far from a probe another one, in this direction, may stand for its bisector, at half of that, to cut the polygon.
GEOMETRY real cut_reach(PolygonReach reach, real probe_radius) {
  return (reach.most_outside <= real(0) ? real(1) : reach.farthest) * real(2) * probe_radius;
}

// When in doubt, yes: every bisector is true (theorem 1.3), it may only be one that cuts nothing.
GEOMETRY bool reaches_bisector(PolygonReach reach, real probe_radius, real distance) {
  return cut_reach(reach, probe_radius) >= distance * (real(1) - real(1) / (real(1000000) * real(1000000)));
}

#endif
