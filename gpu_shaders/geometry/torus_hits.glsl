// SPDX-License-Identifier: BSD-3-Clause
// Finds all intersections of a ray with a torus around the z axis.
//
// This file is written in the common subset of GLSL and C++ with GLM (ray_torus.glsl). It does not work for packets.
#ifndef MENISCUS_GEOMETRY_TORUS_HITS_GLSL
#define MENISCUS_GEOMETRY_TORUS_HITS_GLSL
#include "gpu_shaders/geometry/ray_torus.glsl"

struct TorusHits {
  int count;  // 0 to 4
  real t[4];  // ascending
};

// Returns the points o + t*d, |d| = 1, t in [low, high], on the torus around the z axis, without the lemon of a spindle
// torus. For good precision the ray must start near the torus. tolerance: tolerance of t, about the roundoff.
GEOMETRY TorusHits ray_torus(real3 o, real3 d, real major, real minor, real low, real high, real tolerance) {
  TorusHits hits;
  hits.count = 0;
  hits.t[0] = hits.t[1] = hits.t[2] = hits.t[3] = high;
  real none = real(2) * abs(high) + real(1);
  TorusRuns runs = torus_runs(o, d, major, minor, low, high);
  while (runs.waiting != 0) {
    real root = torus_run(o, d, major, minor, tolerance, none, runs);
    if (root != none && hits.count < 4) hits.t[hits.count++] = root;
  }
  return hits;
}

#endif
