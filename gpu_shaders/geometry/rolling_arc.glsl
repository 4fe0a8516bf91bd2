// SPDX-License-Identifier: BSD-3-Clause
// The toroidal patch of an arc: the circle that the probe's centre rolls on, and where on it the arc begins and ends.
//
// Common subset of GLSL and C++ with GLM, below circle.glsl and fixed_probe.glsl.
#ifndef MENISCUS_GEOMETRY_ROLLING_ARC_GLSL
#define MENISCUS_GEOMETRY_ROLLING_ARC_GLSL

// A circle whose radius differs from the probe's by less than this, Å, is as large as the probe: it touches its axis in one
// point, and rounding must not open a spindle there.
const real kTouchDistance = real(1) / real(1000000000);

// Squared radius, Å², below which two spheres just touch: their circle is the one that decisions saw.
const real kTouchingCircle = real(1) / (real(1000000) * real(1000000));

struct RollingArc {
  real3 center;
  real3 axis;
  real radius;
  real3 start;  // unit vector from the centre towards the begin, perpendicular to the axis
  real cosine;  // of the angle of the arc
  real sine;
};

// A whole turn. origin: centre of the first atom, d: from there to the second; r0, r1: SAS radii; w0, w1: decision weights.
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

// Of a whole turn the part from the probe at `begin` counter-clockwise to that at `end`.
GEOMETRY RollingArc part_between(RollingArc whole, real3 begin, real3 end) {
  RollingArc arc = whole;
  arc.start = direction_on(whole, begin);
  real3 stop = direction_on(whole, end);
  arc.cosine = dot(arc.start, stop);
  arc.sine = dot(arc.axis, cross(arc.start, stop));
  return arc;
}

// Nothing or a whole turn? Positions cannot tell where the ends (nearly) coincide; arc_vanishes() can.
GEOMETRY bool ends_coincide(real3 begin, real3 end) {
  real3 gap = begin - end;
  return dot(gap, gap) < kMergeDistance * kMergeDistance;
}

#endif
