// SPDX-License-Identifier: BSD-3-Clause
// Where a ray meets a sphere around the origin.
//
// Common subset of GLSL and C++ with GLM; the includer defines real, real2, real3, GEOMETRY and GEOMETRY_OUT, and the
// words of shared/lane.glsl: in C++ they may be packets.
// Precision: give a ray that starts near the sphere (a few radii); then the error is a few roundings of the radius.
#ifndef MENISCUS_GEOMETRY_RAY_SPHERE_GLSL
#define MENISCUS_GEOMETRY_RAY_SPHERE_GLSL
#include "gpu_shaders/shared/lane.glsl"

struct SphereHits {
  truth found;
  real near_t;
  real far_t;
};

// Points o + t*d, |d| = 1. Squares are taken only of the distance at closest approach, which keeps all digits.
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

#endif
