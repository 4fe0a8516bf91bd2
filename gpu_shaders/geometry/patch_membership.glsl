// SPDX-License-Identifier: BSD-3-Clause
// Tests if a point of a sphere or a torus belongs to the surface, and finds the atom whose colour the point has.
//
// This file is written in the common subset of GLSL and C++ with GLM. The includer defines real, real2, real3,
// GEOMETRY, GEOMETRY_OUT and GEOMETRY_INOUT. The types of reduced_surface/precision.glsl may be packets in C++. `slack`
// (Å, >= 0) widens a patch past its borders, so that neighbouring patches overlap and no ray passes between them. The
// surface is smooth across contact circles and edges, so the height of the overlap is only slack^2 / radius.
#ifndef MENISCUS_GEOMETRY_PATCH_MEMBERSHIP_GLSL
#define MENISCUS_GEOMETRY_PATCH_MEMBERSHIP_GLSL

// True if x is inside a plane. x: point relative to the origin of the plane; slack: Å.
GEOMETRY truth in_half_space(real3 x, real3 normal, real offset, real slack) {
  return dot(normal, x) <= offset + slack;
}

// Shortens the interval [low, high] to the part where offset + slope*t <= 0.
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

// True if a point of a torus belongs to a toroidal patch (theorem 1.2). The frame is that of the torus: its origin is
// the centre of the SAS circle, x the direction in which the arc starts, z the axis. x: point of the torus; major: R;
// z_low, z_high: planes of the two contact circles; cos_sweep, sin_sweep: cosine and sine of the angle of the arc,
// which runs counter-clockwise; range: kWholeTurn, kUpToHalfTurn or kOverHalfTurn.
GEOMETRY truth in_toroidal_patch(real3 x, real major, real z_low, real z_high, real cos_sweep,
                                 real sin_sweep, int range, real slack) {
  real rho_squared = x.x * x.x + x.y * x.y;
  // The patch is on the side that faces the axis, between the contact circles.
  real limit = major + slack;
  truth between = x.z >= z_low - slack && x.z <= z_high + slack && rho_squared <= limit * limit;
  if (range == kWholeTurn) return between;
  truth after_start = x.y >= -slack;
  truth before_end = x.x * sin_sweep - x.y * cos_sweep >= -slack;
  if (range == kUpToHalfTurn) return between && after_start && before_end;
  return between && (after_start || before_end);
}

// Returns the outward normal, towards the solvent, at a point of the torus around z: towards the centre of the probe
// that touches it there.
GEOMETRY real3 torus_normal(real3 x, real major, real minor) {
  real rho = sqrt(x.x * x.x + x.y * x.y);
  real scale = select(rho > real(0), major / rho - real(1), real(0));
  return real3(x.x * scale, x.y * scale, -x.z) / minor;
}

// True if the second of the two atoms of a toroidal patch is nearer to a point. The directions of the contacts and of
// the point are compared as seen from the probe that touches the point x. z0, z1: heights of the atoms on the axis;
// extended0, extended1: their SAS radii.
GEOMETRY truth toroidal_second_atom(real3 x, real major, real z0, real extended0, real z1, real extended1) {
  real rho = sqrt(x.x * x.x + x.y * x.y);
  // In the half-plane of x, the probe is at (major, 0), and the contact directions are (-major, z)/extended.
  real2 w = real2(rho - major, x.z);
  return dot(w, real2(-major, z1)) * extended0 > dot(w, real2(-major, z0)) * extended1;
}

#endif
