// SPDX-License-Identifier: BSD-3-Clause
// Which part of a sphere or torus belongs to the surface, and whose atom's colour a point takes.
//
// Common subset of GLSL and C++ with GLM; the includer defines real, real2, real3, GEOMETRY, GEOMETRY_OUT and
// GEOMETRY_INOUT; with the words of shared/lane.glsl, which in C++ may be packets.
// `slack` (Å, >= 0) widens a patch past its borders: neighbours then overlap by that much and no ray slips between them.
// Across contact circles and edges the surface is smooth, so the overlap is slack^2 / radius high: nothing.
#ifndef MENISCUS_GEOMETRY_PATCH_MEMBERSHIP_GLSL
#define MENISCUS_GEOMETRY_PATCH_MEMBERSHIP_GLSL
#include "gpu_shaders/shared/lane.glsl"

// x: relative to the plane's own origin.
GEOMETRY truth in_half_space(real3 x, real3 normal, real offset, real slack) {
  return dot(normal, x) <= offset + slack;
}

// Shortens [low, high] to the t where offset + slope*t <= 0.
GEOMETRY void clip_to_half_space(real offset, real slope, GEOMETRY_INOUT(real) low, GEOMETRY_INOUT(real) high) {
  real at = -offset / slope;
  truth empty = slope == real(0) && offset > real(0);
  high = select(slope > real(0), min(high, at), select(empty, low, high));
  low = select(slope < real(0), max(low, at), low);
}

// The angular range of a toroidal patch.
const int kWholeTurn = 0;
const int kUpToHalfTurn = 1;
const int kOverHalfTurn = 2;

// Theorem 1.2, in the torus's own frame: origin = centre of the SAS circle, x = direction in
// which the arc starts, z = axis. x: a point of the torus; major, minor: R and p; z_low, z_high: the planes of the two
// contact circles; cos_sweep, sin_sweep: of the arc, which runs counter-clockwise.
GEOMETRY truth in_toroidal_patch(real3 x, real major, real z_low, real z_high, real cos_sweep,
                                 real sin_sweep, int range, real slack) {
  real rho_squared = x.x * x.x + x.y * x.y;
  // The side that faces the axis, between the contact circles.
  real limit = major + slack;
  truth between = x.z >= z_low - slack && x.z <= z_high + slack && rho_squared <= limit * limit;
  if (range == kWholeTurn) return between;
  truth after_start = x.y >= -slack;
  truth before_end = x.x * sin_sweep - x.y * cos_sweep >= -slack;
  if (range == kUpToHalfTurn) return between && after_start && before_end;
  return between && (after_start || before_end);
}

// Outward normal (towards the solvent) at a point of the torus around z, towards the probe that touches it there.
GEOMETRY real3 torus_normal(real3 x, real major, real minor) {
  real rho = sqrt(x.x * x.x + x.y * x.y);
  real scale = select(rho > real(0), major / rho - real(1), real(0));
  return real3(x.x * scale, x.y * scale, -x.z) / minor;
}

// Of the two atoms of a toroidal patch at heights z0 and z1 on the axis, extended radii R0 and R1, the one whose contact
// direction is nearest to that of the point x, seen from its probe: false for the first.
GEOMETRY truth toroidal_second_atom(real3 x, real major, real z0, real extended0, real z1, real extended1) {
  real rho = sqrt(x.x * x.x + x.y * x.y);
  // In the half-plane of x: the probe is (major, 0), the contact directions are (-major, z)/extended.
  real2 w = real2(rho - major, x.z);
  return dot(w, real2(-major, z1)) * extended0 > dot(w, real2(-major, z0)) * extended1;
}

#endif
