// SPDX-License-Identifier: BSD-3-Clause
// Where a ray meets the lateral surface of a cylinder.
//
// Common subset of GLSL and C++ with GLM; the includer defines real, real3, GEOMETRY, and the words of shared/lane.glsl:
// in C++ they may be packets.
#ifndef MENISCUS_GEOMETRY_RAY_CYLINDER_GLSL
#define MENISCUS_GEOMETRY_RAY_CYLINDER_GLSL
#include "gpu_shaders/geometry/ray_sphere.glsl"

// Points o + t*d, |d| = 1, on the infinite cylinder about `axis` (of length 1) through the origin: in the plane across
// the axis this is a circle, and the ray a line that is shorter by the sine of their angle. Nothing is found along the
// axis. Precision: as ray_sphere.
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

#endif
