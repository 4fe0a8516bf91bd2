// SPDX-License-Identifier: BSD-3-Clause
// The toroidal patch of an arc: the circle on which the probe's centre rolls, and the begin and the end of the arc on
// it.
//
// This file is in the common subset of GLSL and C++ with GLM, and follows circle.glsl and fixed_probe.glsl.
#ifndef MENISCUS_GEOMETRY_ROLLING_ARC_GLSL
#define MENISCUS_GEOMETRY_ROLLING_ARC_GLSL

// A circle whose radius differs from that of the probe by less than this (Å) is as large as the probe. The torus then
// touches its axis in one point, and rounding must not open a spindle there.
const real kTouchDistance = real(1) / real(1000000000);

// Two spheres just touch if the squared radius of their circle (Å²) is below this value. The circle of the decision
// weights is then used.
const real kTouchingCircle = real(1) / (real(1000000) * real(1000000));

struct RollingArc {
  real3 center;
  real3 axis;
  real radius;
  real3 start;  // unit vector from the centre towards the begin, perpendicular to the axis
  real cosine;  // cosine of the angle of the arc
  real sine;    // sine of the angle of the arc
};

// Returns the arc of a whole turn. origin: centre of the first atom; d: vector from there to the second atom; r0, r1:
// SAS radii; w0, w1: decision weights.
GEOMETRY RollingArc whole_turn(real3 origin, real3 d, real r0, real r1, real w0, real w1, real probe_radius) {
  Circle circle = circle_of_two_spheres(d, r0 * r0, r1 * r1);
  if (circle.radius_squared < kTouchingCircle) circle = circle_of_two_spheres(d, w0, w1);
  RollingArc arc;
  arc.center = origin + circle.axis * circle.height;
  arc.axis = circle.axis;
  arc.radius = abs(circle.radius - probe_radius) < kTouchDistance ? probe_radius : circle.radius;
  arc.start = circle.u;
  arc.cosine = real(1);
  arc.sine = real(0);
  return arc;
}

GEOMETRY real3 direction_on(RollingArc arc, real3 position) {
  real3 d = position - arc.center;
  return normalize(d - arc.axis * dot(d, arc.axis));
}

// Returns the part of a whole turn from the probe at `begin` counter-clockwise to the probe at `end`.
GEOMETRY RollingArc part_between(RollingArc whole, real3 begin, real3 end) {
  RollingArc arc = whole;
  arc.start = direction_on(whole, begin);
  real3 stop = direction_on(whole, end);
  arc.cosine = dot(arc.start, stop);
  arc.sine = dot(arc.axis, cross(arc.start, stop));
  return arc;
}

// True if the ends of an arc (nearly) coincide. Positions then do not determine if it is empty or a whole turn, but
// arc_vanishes() does.
GEOMETRY bool ends_coincide(real3 begin, real3 end) {
  real3 gap = begin - end;
  return dot(gap, gap) < kMergeDistance * kMergeDistance;
}

#endif
