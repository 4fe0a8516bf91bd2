// SPDX-License-Identifier: BSD-3-Clause
// Intersects a ray with a sphere around the origin, the lateral surface of a cylinder, or a triangle.
//
// This file is written in the common subset of GLSL and C++ with GLM. The includer defines real, real2, real3,
// GEOMETRY, GEOMETRY_OUT and the types of reduced_surface/precision.glsl, which may be packets in C++. Precision: if
// the ray starts near the sphere, within a few radii, the error is a few roundings of the radius.
#ifndef MENISCUS_GEOMETRY_RAY_SHAPES_GLSL
#define MENISCUS_GEOMETRY_RAY_SHAPES_GLSL

struct SphereHits {
  truth found;
  real near_t;
  real far_t;
};

// Intersects the ray of points o + t*d, |d| = 1, with a sphere. Only the distance at closest approach is squared, which
// keeps all digits.
GEOMETRY SphereHits ray_sphere(real3 o, real3 d, real radius) {
  SphereHits hits;
  real closest_t = -dot(o, d);
  real3 closest = o + d * closest_t;
  real half_chord_squared = radius * radius - dot(closest, closest);
  hits.found = half_chord_squared > real(0);
  real half_chord = sqrt(select(hits.found, half_chord_squared, real(0)));
  hits.near_t = closest_t - half_chord;
  hits.far_t = closest_t + half_chord;
  return hits;
}

// Intersects the ray of points o + t*d, |d| = 1, with the infinite cylinder about `axis` (of length 1) through the
// origin. In the plane perpendicular to the axis, the cylinder is a circle, and the ray is shorter by the sine of their
// angle. A ray along the axis meets nothing. The precision is that of ray_sphere().
GEOMETRY SphereHits ray_cylinder(real3 o, real3 d, real3 axis, real radius) {
  real3 across = o - axis * dot(o, axis);
  real3 along = d - axis * dot(d, axis);
  real sine = length(along);
  truth slanted = sine > real(1e-6);
  sine = select(slanted, sine, real(1));
  SphereHits hits = ray_sphere(across, along / sine, radius);
  hits.found = hits.found && slanted;
  hits.near_t = hits.near_t / sine;
  hits.far_t = hits.far_t / sine;
  return hits;
}

struct TriangleHit {
  truth found;
  real t;
  real u;  // weight of the second corner
  real v;  // weight of the third
};

// Intersects the ray of points o + t*d with both sides of the triangle with one corner at the origin and the edges `e1`
// and `e2` from there (Moeller & Trumbore 1997, J. Graphics Tools 2, 21). The weights may be out of range by `slack`,
// so that neighbouring triangles leave no gap.
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
