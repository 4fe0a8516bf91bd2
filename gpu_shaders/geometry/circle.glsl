// SPDX-License-Identifier: BSD-3-Clause
// The circle where two spheres meet, and which parts of it other balls cover: the predicates of the whole program.
//
// Written in the common subset of GLSL and C++ with GLM. The includer defines `real`, `real2`, `real3` and
// `GEOMETRY` (inline in C++, nothing in GLSL). Only + - * / and sqrt decide anything, for GLSL bounds their errors, and
// not those of trigonometric functions. What they yield differs between devices all the same: a*b + c may be fused,
// a quotient is good to 2.5 units in the last place and sqrt, by way of inversesqrt, to 4.5. half_plane_noise() covers
// all that; docs/explanation/theory.md derives it.
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
  real inverse_radius;  // 0 where there is no circle
  real slackness;  // how much unequal lengths magnify rounding, at least 3
};

// d: second centre; w0, w1: weights (Sanner, Olson & Spehner 1996; power of a point).
GEOMETRY Circle circle_of_two_spheres(real3 d, real w0, real w1) {
  Circle c;
  real distance = sqrt(dot(d, d));
  c.axis = d / distance;
  c.height = (distance * distance + w0 - w1) / (real(2) * distance);
  c.radius_squared = w0 - c.height * c.height;
  c.radius = c.radius_squared > real(0) ? sqrt(c.radius_squared) : real(0);
  c.inverse_radius = c.radius > real(0) ? real(1) / c.radius : real(0);
  c.u = perpendicular(c.axis);
  c.v = cross(c.axis, c.u);
  real ratio = sqrt(w0) / distance;
  c.slackness = real(1) + ratio + real(1) / ratio;
  return c;
}

// A ball as that which may cover parts of circles around a first ball.
struct Blocker {
  real3 center;  // relative to the first ball's
  real weight;
  real square;      // of the distance
  real distance;
  real half_power;  // (first weight + square - weight) / 2: covered points x of the first sphere have dot(x, center) above it
};

GEOMETRY Blocker blocking_ball(real3 center, real weight, real first_weight) {
  Blocker ball;
  ball.center = center;
  ball.weight = weight;
  ball.square = dot(center, center);
  ball.distance = sqrt(ball.square);
  ball.half_power = (first_weight + ball.square - weight) * real(0.5);
  return ball;
}

// What a ball covers of the unit circle (x, y): the open half-plane dot(normal, (x, y)) > offset.
struct HalfPlane {
  real2 normal;
  real offset;
  real length_squared;  // of normal
  real length_bound;    // not below the length of normal
  real error;           // bound on |error of dot(normal, (x, y)) - offset| by rounding
};

// Bound on the rounding error of covered_half_plane() over (qq + w0) * (1 + |q| / radius). epsilon: unit roundoff of
// `real`; the 18 is the worst sum of all errors, those of the numbers that come in included.
GEOMETRY real half_plane_noise(Circle c, real epsilon) {
  return real(18) * c.slackness * epsilon * c.inverse_radius;
}

// q: centre of the covering ball relative to the circle's first ball, q_length its length; w0: weight of that first
// ball; wq: of this one; epsilon: unit roundoff of `real`. A point x of the circle has |x|^2 = w0, so |x - q|^2 < wq
// is linear in x.
GEOMETRY HalfPlane covered_half_plane(Circle c, real w0, real3 q, real q_length, real wq, real epsilon) {
  HalfPlane h;
  real qq = dot(q, q);
  h.normal = real2(dot(c.u, q), dot(c.v, q));
  h.offset = ((w0 + qq - wq) * real(0.5) - c.height * dot(c.axis, q)) * c.inverse_radius;
  h.length_squared = dot(h.normal, h.normal);
  h.length_bound = q_length;
  h.error = half_plane_noise(c, epsilon) * (qq + w0) * (real(1) + q_length * c.inverse_radius);
  return h;
}

// Whether two balls overlap; d: from one centre to the other.
GEOMETRY bool balls_overlap(real3 d, real w0, real w1) {
  real sum = sqrt(w0) + sqrt(w1);
  return dot(d, d) < sum * sum;
}

// What lies past the axis of a spindle circle through both probes of a pair: not in the half-plane that `direction`
// (unit, perpendicular to that axis) points into from the spindle circle's centre `axis_point`.
GEOMETRY HalfPlane half_plane_past_axis(Circle c, real3 direction, real3 axis_point) {
  HalfPlane h;
  h.normal = real2(-dot(c.u, direction), -dot(c.v, direction));
  h.offset = dot(direction, c.axis * c.height - axis_point) / c.radius;
  h.length_squared = dot(h.normal, h.normal);
  h.length_bound = real(1);
  h.error = real(0);  // ends at named points: the order around the axis decides, not this arithmetic
  return h;
}

// Most balls miss a circle or cover all of it, and surely so; telling that needs no half-plane. offset: negative if the ball
// covers the circle. w0: weight of the circle's first ball; noise: half_plane_noise(); the numbers of the ball as in Blocker;
// epsilon: unit roundoff of `real`.
GEOMETRY bool surely_apart(Circle c, real w0, real noise, real3 center, real square, real distance, real half_power,
                           real epsilon, GEOMETRY_OUT(real) offset) {
  real along = dot(c.axis, center);
  offset = (half_power - c.height * along) * c.inverse_radius;
  real beyond = abs(offset) - noise * (square + w0) * (real(1) + distance * c.inverse_radius);
  // The right side is never below zero.
  return beyond * abs(beyond) > square * (real(1) + real(90) * epsilon) - along * along;
}

// How a ball meets the whole circle.
const int kMisses = 0;
const int kCuts = 1;
const int kCovers = 2;

// margin: below zero when rounding could change the answer.
GEOMETRY int meet_circle(HalfPlane h, GEOMETRY_OUT(real) margin) {
  real gap = h.offset * h.offset - h.length_squared;
  margin = abs(gap) - real(2) * h.error * (abs(h.offset) + h.length_bound);
  if (gap < real(0)) return kCuts;
  return h.offset > real(0) ? kMisses : kCovers;
}

// How the axis of that spindle circle meets the pair's circle: kCuts: the half-plane covers a part of it. A spindle circle
// as large as the probe touches its axis: then the pair's circle lies before the axis or past it as a whole.
// margin: how far the squares that are compared are apart, over that of the circle's radius.
GEOMETRY int meet_axis(HalfPlane past, bool touching, GEOMETRY_OUT(real) margin) {
  real gap = past.length_squared - past.offset * past.offset;
  margin = abs(gap);
  if (gap > real(0) && !touching) return kCuts;
  return past.offset < real(0) ? kCovers : kMisses;
}

// Monotone stand-in for the angle of a vector of any length, counter-clockwise from (1, 0), in [0, 4): one quotient,
// no trigonometry. Its slope over the angle is at most 1.
GEOMETRY real pseudo_angle(real2 a) {
  real r = a.y / (abs(a.x) + abs(a.y));
  if (a.x < real(0)) return real(2) - r;
  return r < real(0) ? real(4) + r : r;
}

// The unit vector with that pseudo-angle.
GEOMETRY real2 direction_at(real pseudo) {
  real x = pseudo < real(2) ? real(1) - pseudo : pseudo - real(3);
  real y = real(1) - abs(x);
  if (pseudo > real(2)) y = -y;
  return real2(x, y) * (real(1) / sqrt(x * x + y * y));
}

// The covered arc of a cutting half-plane in pseudo-angles: it runs counter-clockwise from `begin` to `end`.
struct CoveredArc {
  real begin;
  real end;
  real error;  // bound on the error of both
};

GEOMETRY CoveredArc covered_arc(HalfPlane h) {
  CoveredArc a;
  real s = sqrt(h.length_squared - h.offset * h.offset);
  real2 middle = h.normal * h.offset;
  real2 half_chord = real2(-h.normal.y, h.normal.x) * s;
  a.begin = pseudo_angle(middle - half_chord);
  a.end = pseudo_angle(middle + half_chord);
  a.error = real(8) * h.error / s;  // s is not above the normal's length
  return a;
}

// Distance from pseudo-angle a counter-clockwise to b, in [0, 4].
GEOMETRY real pseudo_sweep(real a, real b) {
  real d = b - a;
  return d < real(0) ? d + real(4) : d;
}

// What a ball q of weight wq covers of a circle that it is known to cut.
GEOMETRY CoveredArc covered_by(Circle c, real w0, real3 q, real wq) {
  return covered_arc(covered_half_plane(c, w0, q, real(0), wq, real(0)));
}

// Of the two arcs between a point of a circle and (nearly) the same one: whether the exposed one, from the end of what
// `before` covers to the begin of what `behind` does, is nothing rather than (nearly) a whole turn. It leaves out what
// either covers: where it seems not to, rounding has changed the sign of nothing. So the answer holds in any precision,
// unless the roots of both covered arcs are lost in rounding: in double, each is less than 1e-7 of the circle then.
GEOMETRY bool arc_vanishes(CoveredArc before, CoveredArc behind) {
  real exposed = pseudo_sweep(before.end, behind.begin);
  real covered = max(pseudo_sweep(before.begin, before.end), pseudo_sweep(behind.begin, behind.end));
  return exposed < real(1) || exposed > real(4) - real(0.5) * covered;
}

// What remains of an exposed arc (counter-clockwise from begin to end) once a ball has covered its share.
const int kKeep = 0;
const int kRemove = 1;
const int kCutBegin = 2;    // new begin: end of the covered arc
const int kCutEnd = 3;      // new end: begin of the covered arc
const int kComplement = 4;  // both ends covered, the middle is not: from the covered arc's end to its begin
const int kSplit = 5;       // the middle is covered: two arcs

// margin: how far the decisive end points are apart, less than the errors of both when rounding could change it.
GEOMETRY int clip_arc(real begin, real end, CoveredArc covered, GEOMETRY_OUT(real) margin) {
  real arc_end = pseudo_sweep(begin, end);
  real covered_begin = pseudo_sweep(begin, covered.begin);
  real covered_end = pseudo_sweep(begin, covered.end);
  margin = min(min(abs(covered_begin - arc_end), abs(covered_end - arc_end)),
               min(min(covered_begin, real(4) - covered_begin), min(covered_end, real(4) - covered_end)));
  if (covered_end < covered_begin) {  // the arc's begin is covered
    if (covered_end >= arc_end) return kRemove;
    return covered_begin < arc_end ? kComplement : kCutBegin;
  }
  if (covered_begin >= arc_end) return kKeep;
  return covered_end < arc_end ? kSplit : kCutEnd;
}

// A part of a circle that no ball covers so far, counter-clockwise, and the labels of those that cover what lies before
// its begin and behind its end.
struct ExposedArc {
  real begin;  // pseudo-angles
  real end;
  uint begin_by;
  uint end_by;
};

GEOMETRY ExposedArc exposed_arc(real begin, real end, uint begin_by, uint end_by) {
  ExposedArc arc;
  arc.begin = begin;
  arc.end = end;
  arc.begin_by = begin_by;
  arc.end_by = end_by;
  return arc;
}

// Takes from an arc what the ball `label` covers; says how, as clip_arc() does. kSplit: `second` is what is left behind
// the covered part.
GEOMETRY int cut_arc(GEOMETRY_INOUT(ExposedArc) arc, CoveredArc covered, uint label,
                     GEOMETRY_INOUT(ExposedArc) second, GEOMETRY_OUT(real) margin) {
  int change = clip_arc(arc.begin, arc.end, covered, margin);
  if (change == kComplement) arc = exposed_arc(covered.end, covered.begin, label, label);
  if (change == kSplit) second = exposed_arc(covered.end, arc.end, label, arc.end_by);
  if (change == kCutBegin) {
    arc.begin = covered.end;
    arc.begin_by = label;
  }
  if (change == kCutEnd || change == kSplit) {
    arc.end = covered.begin;
    arc.end_by = label;
  }
  return change;
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
