// SPDX-License-Identifier: BSD-3-Clause
// Where a ray meets a triangle.
//
// Common subset of GLSL and C++ with GLM; the includer defines real, real3, GEOMETRY, and the words of shared/lane.glsl:
// in C++ they may be packets.
#ifndef MENISCUS_GEOMETRY_RAY_TRIANGLE_GLSL
#define MENISCUS_GEOMETRY_RAY_TRIANGLE_GLSL
#include "gpu_shaders/shared/lane.glsl"

struct TriangleHit {
  truth found;
  real t;
  real u;  // weight of the second corner
  real v;  // weight of the third
};

// Points o + t*d of the triangle with one corner at the origin and edges `e1` and `e2` from there, both sides. Moeller &
// Trumbore 1997, J. Graphics Tools 2, 21. The weights may lie outside by `slack`, so that neighbours leave no gap.
GEOMETRY TriangleHit ray_triangle(real3 o, real3 d, real3 e1, real3 e2, real slack) {
  TriangleHit hit;
  real3 p = cross(d, e2);
  real determinant = dot(e1, p);
  hit.found = determinant != real(0);
  real inverse = real(1) / select(hit.found, determinant, real(1));
  real3 q = cross(o, e1);
  hit.u = dot(o, p) * inverse;
  hit.v = dot(d, q) * inverse;
  hit.t = dot(e2, q) * inverse;
  hit.found = hit.found && hit.u >= -slack && hit.v >= -slack && hit.u + hit.v <= real(1) + slack;
  return hit;
}

#endif
