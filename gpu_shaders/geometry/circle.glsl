// SPDX-License-Identifier: BSD-3-Clause
// The circle where two spheres meet, and which parts of it other balls cover: the predicates of the whole program.
//
// Written in the common subset of GLSL and C++ with GLM. The includer defines `real`, `real2`, `real3` and
// `GEOMETRY` (inline in C++, nothing in GLSL). Only + - * / and sqrt decide anything: they are exact to the last bit
// on every device, where trigonometric functions and fused products are not.
//
// All positions are relative to the centre of the circle's first ball. A ball is a centre and a weight (squared radius).
#ifndef MENISCUS_GEOMETRY_CIRCLE_GLSL
#define MENISCUS_GEOMETRY_CIRCLE_GLSL

// Unit vector perpendicular to the unit vector n.
GEOMETRY real3 perpendicular(real3 n) {
  real ax = abs(n.x);
  real ay = abs(n.y);
  real az = abs(n.z);
  real3 e = real3(real(0), real(0), real(1));
  if (ax <= ay && ax <= az) e = real3(real(1), real(0), real(0));
  else if (ay <= az) e = real3(real(0), real(1), real(0));
  real3 c = cross(n, e);
  return c / sqrt(dot(c, c));
}

// Circle of the spheres around 0 and d: points height*axis + radius*(x*u + y*v) with x*x + y*y = 1, counter-clockwise
// about the axis, which points from the first centre to the second.
struct Circle {
  real3 axis;
  real3 u;
  real3 v;
  real height;
  real radius_squared;  // not positive: the spheres do not meet
  real radius;
  real slackness;  // how much near coincident centres magnify rounding, at least 1
};

// d: second centre; w0, w1: weights (Sanner, Olson & Spehner 1996; power of a point).
GEOMETRY Circle circle_of_two_spheres(real3 d, real w0, real w1) {
  Circle c;
  real distance = sqrt(dot(d, d));
  c.axis = d / distance;
  c.height = (distance * distance + w0 - w1) / (real(2) * distance);
  c.radius_squared = w0 - c.height * c.height;
  c.radius = c.radius_squared > real(0) ? sqrt(c.radius_squared) : real(0);
  c.u = perpendicular(c.axis);
  c.v = cross(c.axis, c.u);
  c.slackness = real(1) + sqrt(w0) / distance;
  return c;
}

// What a ball covers of the unit circle (x, y): the open half-plane dot(normal, (x, y)) > offset.
struct HalfPlane {
  real2 normal;
  real offset;
  real length_squared;  // of normal
  real error;           // bound on |error of dot(normal, (x, y)) - offset| by rounding
};

// q: centre of the covering ball relative to the circle's first ball; w0: weight of that first ball; wq: of this one;
// epsilon: unit roundoff of `real`. A point x of the circle has |x|^2 = w0, so |x - q|^2 < wq is linear in x.
GEOMETRY HalfPlane covered_half_plane(Circle c, real w0, real3 q, real wq, real epsilon) {
  HalfPlane h;
  real qq = dot(q, q);
  h.normal = real2(dot(c.u, q), dot(c.v, q));
  h.offset = ((w0 + qq - wq) * real(0.5) - c.height * dot(c.axis, q)) / c.radius;
  h.length_squared = dot(h.normal, h.normal);
  h.error = real(8) * c.slackness * epsilon * (qq + w0) * (c.radius + sqrt(qq)) / (c.radius * c.radius);
  return h;
}

// What lies past the axis of a spindle circle through both probes of a pair: not in the half-plane that `direction`
// (unit, perpendicular to that axis) points into from the spindle circle's centre `axis_point`.
GEOMETRY HalfPlane half_plane_past_axis(Circle c, real3 direction, real3 axis_point) {
  HalfPlane h;
  h.normal = real2(-dot(c.u, direction), -dot(c.v, direction));
  h.offset = dot(direction, c.axis * c.height - axis_point) / c.radius;
  h.length_squared = dot(h.normal, h.normal);
  h.error = real(0);  // ends at named points: the order around the axis decides, not this arithmetic
  return h;
}

// How a ball meets the whole circle.
const int kMisses = 0;
const int kCuts = 1;
const int kCovers = 2;

// margin: below zero when rounding could change the answer.
GEOMETRY int meet_circle(HalfPlane h, GEOMETRY_OUT(real) margin) {
  real gap = h.offset * h.offset - h.length_squared;
  margin = abs(gap) - real(2) * h.error * (abs(h.offset) + sqrt(h.length_squared));
  if (gap < real(0)) return kCuts;
  return h.offset > real(0) ? kMisses : kCovers;
}

// End points of the covered arc of a cutting half-plane: it runs counter-clockwise from `begin` to `end`.
struct CoveredArc {
  real2 begin;
  real2 end;
  real error;  // bound on the error of the end points
};

GEOMETRY CoveredArc covered_arc(HalfPlane h) {
  CoveredArc a;
  real s = sqrt(h.length_squared - h.offset * h.offset);
  real inverse = real(1) / h.length_squared;
  real2 middle = h.normal * (h.offset * inverse);
  real2 half_chord = real2(-h.normal.y, h.normal.x) * (s * inverse);
  a.begin = middle - half_chord;
  a.end = middle + half_chord;
  a.error = real(4) * h.error * (real(1) / s + sqrt(inverse));
  return a;
}

// Monotone stand-in for the angle from unit vector a to unit vector b, counter-clockwise, in [0, 4).
GEOMETRY real pseudo_angle(real2 a, real2 b) {
  real c = dot(a, b);
  real s = a.x * b.y - a.y * b.x;
  if (s >= real(0)) return c >= real(0) ? s / (c + s) : real(1) - c / (s - c);
  return c < real(0) ? real(2) + s / (c + s) : real(3) + c / (c - s);
}

// What remains of an exposed arc (counter-clockwise from a to b) once a cutting ball has covered its share.
const int kKeep = 0;
const int kCutBegin = 1;    // new begin: end of the covered arc
const int kCutEnd = 2;      // new end: begin of the covered arc
const int kRemove = 3;
const int kComplement = 4;  // both ends covered, the middle is not: from the covered arc's end to its begin
const int kSplit = 5;       // the middle is covered: two arcs

GEOMETRY int clip_arc(real2 a, real a_error, real2 b, real b_error, HalfPlane h, CoveredArc covered,
                      GEOMETRY_OUT(real) margin) {
  real length = sqrt(h.length_squared);
  real fa = dot(h.normal, a) - h.offset;
  real fb = dot(h.normal, b) - h.offset;
  margin = min(abs(fa) - (h.error + length * a_error), abs(fb) - (h.error + length * b_error));
  bool a_in = fa > real(0);
  bool b_in = fb > real(0);
  if (a_in && !b_in) return kCutBegin;
  if (b_in && !a_in) return kCutEnd;
  real2 p = a_in ? covered.end : covered.begin;
  bool inside = pseudo_angle(a, p) < pseudo_angle(a, b);
  if (a_in) return inside ? kComplement : kRemove;
  return inside ? kSplit : kKeep;
}

// Point at distance sqrt(w) from three centres a, b, c (given relative to a: 0, b, c), on the side of cross(b, c) if
// side is +1, on the other if -1. Returned relative to a; h2 is the squared height over the plane of the centres,
// clamped to zero in the point when negative.
GEOMETRY real3 probe_of_three(real3 b, real3 c, real wa, real wb, real wc, real side, GEOMETRY_OUT(real) h2) {
  real3 n = cross(b, c);
  real nn = dot(n, n);
  real beta = (dot(b, b) + wa - wb) * real(0.5);   // dot(b, x)
  real gamma = (dot(c, c) + wa - wc) * real(0.5);  // dot(c, x)
  real3 foot = (cross(c, n) * beta + cross(n, b) * gamma) / nn;
  h2 = wa - dot(foot, foot);
  return foot + n * (side * sqrt((h2 > real(0) ? h2 : real(0)) / nn));
}

#endif
