// SPDX-License-Identifier: BSD-3-Clause
// The clips and bounds of patches: contact planes, the shape of a saddle, and bounding spheres.
//
// This file is written in the common subset of GLSL and C++ with GLM (circle.glsl).
#ifndef MENISCUS_GEOMETRY_PATCH_BOUNDS_GLSL
#define MENISCUS_GEOMETRY_PATCH_BOUNDS_GLSL

// A sphere around a patch.
struct PatchBound {
  real3 center;
  real radius;
};

// A bounding sphere relative to a camera.
struct SeenBound {
  bool in_front;  // true if a part of it is in front of the camera
  real3 center;   // relative to the pivot
  real radius;    // widened by the slack of pictures and by rounding to single precision
  real nearest;   // lower bound on the distance of its points from the camera (orthographic: from its plane)
};

// Returns a bound relative to a camera. slack, pivot, eye_distance: members of PrimitiveParameters.
GEOMETRY SeenBound see_bound(PatchBound bound, real slack, real3 pivot, real3 camera_position, real3 forward,
                             real eye_distance, bool orthographic) {
  const real rounding = real(1) / real(1000000);
  SeenBound seen;
  seen.radius = bound.radius * (real(1) + rounding) + real(4) * slack;
  seen.center = bound.center - pivot;
  real depth = eye_distance + dot(seen.center, forward);
  seen.in_front = depth + seen.radius > real(0);
  real distance = orthographic ? depth : length(bound.center - camera_position);
  seen.nearest = (distance - seen.radius) - rounding * (abs(distance) + seen.radius);
  return seen;
}

// Returns a bound of a spherical cap: the points with a direction from the centre at an angle to the unit vector `axis`
// that has a cosine of at least `cosine`.
GEOMETRY PatchBound cap_bound(real3 center, real radius, real3 axis, real cosine) {
  PatchBound bound;
  bound.center = center;
  bound.radius = radius;
  if (cosine <= real(0)) return bound;
  real square = real(1) - cosine * cosine;
  bound.center = center + axis * (radius * cosine);
  bound.radius = radius * sqrt(square > real(0) ? square : real(0));
  return bound;
}

// Returns the distance of the plane of the contact circle of two atoms from the centre of the first, towards the second
// (theorem 1.1). radius: radius of the first atom; ra, rb: both SAS radii.
GEOMETRY real contact_height(real distance, real radius, real ra, real rb) {
  return (distance * distance + ra * ra - rb * rb) / (real(2) * distance) * (radius / ra);
}

// A toroidal patch in its own frame, with the origin at the centre of the SAS circle and z along its axis
// (patch_membership.glsl).
struct SaddleShape {
  real height[2];       // z of the atoms
  real extended[2];     // SAS radii of the atoms
  real contact_z[2];    // z of the contact circles
  real contact_rho[2];  // radii of the contact circles
  real clip_z;          // z of the centre of the sphere through both contact circles
  real clip_radius;     // radius of that sphere
};

// Returns the shape of a toroidal patch. height0, height1: z of the atoms; r0, r1: their radii; major: radius of the
// SAS circle.
GEOMETRY SaddleShape saddle_shape(real height0, real height1, real r0, real r1, real major, real probe_radius) {
  SaddleShape s;
  s.height[0] = height0;
  s.height[1] = height1;
  s.extended[0] = r0 + probe_radius;
  s.extended[1] = r1 + probe_radius;
  s.contact_z[0] = height0 * (probe_radius / s.extended[0]);
  s.contact_z[1] = height1 * (probe_radius / s.extended[1]);
  s.contact_rho[0] = major * (r0 / s.extended[0]);
  s.contact_rho[1] = major * (r1 / s.extended[1]);
  s.clip_z = real(0.5) * (s.contact_z[0] + s.contact_z[1]) +
             real(0.5) * (s.contact_rho[1] - s.contact_rho[0]) * (s.contact_rho[1] + s.contact_rho[0]) /
                 (s.contact_z[1] - s.contact_z[0]);
  real along = s.contact_z[0] - s.clip_z;
  s.clip_radius = sqrt(s.contact_rho[0] * s.contact_rho[0] + along * along);
  return s;
}

// Returns the distance from the centre of a spindle torus at which it meets its axis.
GEOMETRY real spindle_tip_height(real major, real probe_radius) {
  return sqrt((probe_radius - major) * (probe_radius + major));
}

// Returns the cosine and the sine of half an angle in [0, 2 pi), which is given by its cosine and its sine.
GEOMETRY real2 half_angle(real cosine, real sine) {
  real half_cosine = sqrt(max(real(0.5) + real(0.5) * cosine, real(0)));
  return real2(sine < real(0) ? -half_cosine : half_cosine, sqrt(max(real(0.5) - real(0.5) * cosine, real(0))));
}

// Returns a bound of a toroidal patch. axis: unit vector; start: unit vector from the centre to where the arc begins;
// half_sweep: cosine and sine of half the angle of the arc, which is in [0, 2 pi].
GEOMETRY PatchBound saddle_bound(SaddleShape s, real3 center, real3 axis, real3 start, real major, real2 half_sweep,
                                 real probe_radius) {
  // In cylinder coordinates the patch lies in a box; the farthest point from the centre is one of its corners.
  real rho_low = max(major - probe_radius, real(0));
  real rho_high = max(s.contact_rho[0], s.contact_rho[1]);
  real rho_mid = half_sweep.x > real(0) ? real(0.5) * (rho_low + rho_high) * half_sweep.x : real(0);
  real along = real(0.5) * (s.contact_z[1] - s.contact_z[0]);
  real square = real(0);
  for (int high = 0; high < 2; ++high) {
    real rho = high == 1 ? rho_high : rho_low;
    real base = rho * rho + rho_mid * rho_mid;
    square = max(square, max(base - real(2) * rho * rho_mid, base - real(2) * rho * rho_mid * half_sweep.x));
  }
  real3 middle = start * half_sweep.x + cross(axis, start) * half_sweep.y;
  PatchBound bound;
  bound.center = center + middle * rho_mid + axis * (real(0.5) * (s.contact_z[0] + s.contact_z[1]));
  bound.radius = sqrt(square + along * along);
  return bound;
}

#endif
