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

#endif
