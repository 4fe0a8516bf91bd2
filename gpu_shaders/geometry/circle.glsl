// SPDX-License-Identifier: BSD-3-Clause
// The circle in which two spheres meet, and the parts of it that other balls cover: the predicates of the whole
// program.
//
// This file is written in the common subset of GLSL and C++ with GLM. The includer defines `real`, `real2`, `real3` and
// `GEOMETRY` (inline in C++, nothing in GLSL). Decisions use + - * / and sqrt only, because GLSL bounds their errors,
// but not the errors of trigonometric functions. Results still differ between devices: a*b + c may be fused, a quotient
// is good to 2.5 units in the last place, and sqrt, computed by inversesqrt, to 4.5. half_plane_noise() covers all of
// this; docs/explanation/theory.md derives it.
//
// Positions are relative to the first ball's centre. A ball is a centre and a weight (squared radius).
#ifndef MENISCUS_GEOMETRY_CIRCLE_GLSL
#define MENISCUS_GEOMETRY_CIRCLE_GLSL

// Returns a unit vector perpendicular to the unit vector n.
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

// The circle of the spheres around 0 and d. Its points are height*axis + radius*(x*u + y*v) with x*x + y*y = 1,
// counter-clockwise about the axis, which points from the first centre to the second.
struct Circle {
  real3 axis;
  real3 u;
  real3 v;
  real height;
  real radius_squared;  // not positive if the spheres do not meet
  real radius;
  real inverse_radius;  // 0 if there is no circle
  real slackness;       // factor by which unequal lengths magnify rounding, at least 3
};

// Returns the circle of two spheres. d: second centre; w0, w1: weights (Sanner, Olson & Spehner 1996; power of a
// point).
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

// A ball that may cover parts of circles on a first ball.
struct Blocker {
  real3 center;  // relative to the centre of the first ball
  real weight;
  real square;  // squared distance of the centres
  real distance;
  // (first weight + square - weight) / 2. Points x of the first sphere are covered if dot(x, center) is greater.
  real half_power;
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

// The part of the unit circle (x, y) that a ball covers: the open half-plane dot(normal, (x, y)) > offset.
struct HalfPlane {
  real2 normal;
  real offset;
  real length_squared;  // squared length of normal
  real length_bound;    // upper bound on the length of normal
  real error;           // bound on |error of dot(normal, (x, y)) - offset| by rounding
};

// Returns a bound on the rounding error of covered_half_plane(), divided by (qq + w0) * (1 + |q| / radius). epsilon:
// unit roundoff of `real`. The factor 18 is the worst sum of all errors, including the arguments' errors.
GEOMETRY real half_plane_noise(Circle c, real epsilon) {
  return real(18) * c.slackness * epsilon * c.inverse_radius;
}

// Returns the half-plane that a ball covers. A point x of the circle has |x|^2 = w0, so |x - q|^2 < wq is linear in x.
// q: centre of the covering ball relative to the circle's first ball; q_length: length of q; w0: weight of the first
// ball; wq: weight of the covering ball; epsilon: unit roundoff of `real`.
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

// True if two balls overlap. d: vector from one centre to the other.
GEOMETRY bool balls_overlap(real3 d, real w0, real w1) {
  real sum = sqrt(w0) + sqrt(w1);
  return dot(d, d) < sum * sum;
}

// Returns the part of a pair's circle that lies past the axis of a spindle circle through both probes: outside of the
// half-plane into which `direction` (of unit length, perpendicular to that axis) points from `axis_point`, the centre
// of the spindle circle.
GEOMETRY HalfPlane half_plane_past_axis(Circle c, real3 direction, real3 axis_point) {
  HalfPlane h;
  h.normal = real2(-dot(c.u, direction), -dot(c.v, direction));
  h.offset = dot(direction, c.axis * c.height - axis_point) / c.radius;
  h.length_squared = dot(h.normal, h.normal);
  h.length_bound = real(1);
  h.error = real(0);  // the order around the axis decides about the ends, which are named points, not this arithmetic
  return h;
}

// True if a ball certainly misses a circle or covers all of it. That is the most frequent case, and needs no
// half-plane. offset: negative if the ball covers the circle. w0: weight of the circle's first ball; noise:
// half_plane_noise(); center, square, distance, half_power: members of Blocker; epsilon: unit roundoff of `real`.
GEOMETRY bool surely_apart(Circle c, real w0, real noise, real3 center, real square, real distance, real half_power,
                           real epsilon, GEOMETRY_OUT(real) offset) {
  real along = dot(c.axis, center);
  offset = (half_power - c.height * along) * c.inverse_radius;
  real beyond = abs(offset) - noise * (square + w0) * (real(1) + distance * c.inverse_radius);
  // The right side is never negative.
  return beyond * abs(beyond) > square * (real(1) + real(90) * epsilon) - along * along;
}

// The ways in which a ball meets the whole circle.
const int kMisses = 0;
const int kCuts = 1;
const int kCovers = 2;

// Returns kMisses, kCuts or kCovers for a half-plane and the whole circle. margin: negative if rounding could change
// the result.
GEOMETRY int meet_circle(HalfPlane h, GEOMETRY_OUT(real) margin) {
  real gap = h.offset * h.offset - h.length_squared;
  margin = abs(gap) - real(2) * h.error * (abs(h.offset) + h.length_bound);
  if (gap < real(0)) return kCuts;
  return h.offset > real(0) ? kMisses : kCovers;
}

// Returns how the axis of a spindle circle meets the pair's circle; kCuts means that half_plane_past_axis() covers a
// part of it. A spindle circle as large as the probe touches its axis (touching): then the whole circle of the pair
// lies before the axis or past it. margin: difference of the compared squares, relative to the squared radius of the
// circle.
GEOMETRY int meet_axis(HalfPlane past, bool touching, GEOMETRY_OUT(real) margin) {
  real gap = past.length_squared - past.offset * past.offset;
  margin = abs(gap);
  if (gap > real(0) && !touching) return kCuts;
  return past.offset < real(0) ? kCovers : kMisses;
}

// Returns the pseudo-angle of a vector of any length: a monotone function of its angle, counter-clockwise from (1, 0),
// in [0, 4). It needs one quotient and no trigonometry. Its derivative with respect to the angle is at most 1.
GEOMETRY real pseudo_angle(real2 a) {
  real r = a.y / (abs(a.x) + abs(a.y));
  if (a.x < real(0)) return real(2) - r;
  return r < real(0) ? real(4) + r : r;
}

// Returns the unit vector with a pseudo-angle.
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
  real error;  // bound on the error of both ends
};

GEOMETRY CoveredArc covered_arc(HalfPlane h) {
  CoveredArc a;
  real s = sqrt(h.length_squared - h.offset * h.offset);
  real2 middle = h.normal * h.offset;
  real2 half_chord = real2(-h.normal.y, h.normal.x) * s;
  a.begin = pseudo_angle(middle - half_chord);
  a.end = pseudo_angle(middle + half_chord);
  a.error = real(8) * h.error / s;  // s is at most the length of the normal
  return a;
}

// Returns the distance from pseudo-angle a counter-clockwise to b, in [0, 4].
GEOMETRY real pseudo_sweep(real a, real b) {
  real d = b - a;
  return d < real(0) ? d + real(4) : d;
}

// Returns the part that a ball q of weight wq covers of a circle that it is known to cut.
GEOMETRY CoveredArc covered_by(Circle c, real w0, real3 q, real wq) {
  return covered_arc(covered_half_plane(c, w0, q, real(0), wq, real(0)));
}

// True if an exposed arc whose ends (nearly) coincide is empty, false if it is (nearly) a whole turn. The arc runs from
// the end of the arc covered by `before` to the begin of the arc covered by `behind`. An exposed arc contains no
// covered part; if it seems to, rounding has changed the sign of an empty arc. So the result holds in any precision,
// unless the roots of both covered arcs are lost in rounding: in double precision, each of them is then less than 1e-7
// of the circle.
GEOMETRY bool arc_vanishes(CoveredArc before, CoveredArc behind) {
  real exposed = pseudo_sweep(before.end, behind.begin);
  real covered = max(pseudo_sweep(before.begin, before.end), pseudo_sweep(behind.begin, behind.end));
  return exposed < real(1) || exposed > real(4) - real(0.5) * covered;
}

// The effects of a covered arc on an exposed arc, which runs counter-clockwise from begin to end.
const int kKeep = 0;
const int kRemove = 1;
const int kCutBegin = 2;    // new begin: end of the covered arc
const int kCutEnd = 3;      // new end: begin of the covered arc
const int kComplement = 4;  // both ends covered, the middle is not: from the covered arc's end to its begin
const int kSplit = 5;       // the middle is covered: two arcs

// Returns the effect of a covered arc on an exposed arc. margin: the least distance of end points that determine the
// result; rounding could change the result if it is less than the errors of both.
GEOMETRY int clip_arc(real begin, real end, CoveredArc covered, GEOMETRY_OUT(real) margin) {
  real arc_end = pseudo_sweep(begin, end);
  real covered_begin = pseudo_sweep(begin, covered.begin);
  real covered_end = pseudo_sweep(begin, covered.end);
  margin = min(min(abs(covered_begin - arc_end), abs(covered_end - arc_end)),
               min(min(covered_begin, real(4) - covered_begin), min(covered_end, real(4) - covered_end)));
  if (covered_end < covered_begin) {  // the begin of the arc is covered
    if (covered_end >= arc_end) return kRemove;
    return covered_begin < arc_end ? kComplement : kCutBegin;
  }
  if (covered_begin >= arc_end) return kKeep;
  return covered_end < arc_end ? kSplit : kCutEnd;
}

// A counter-clockwise part of a circle that no ball covers so far, with the labels of the balls that cover the parts
// before its begin and after its end.
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

// Removes from an arc the part that the ball `label` covers, and returns the result of clip_arc(). For kSplit, `second`
// becomes the part after the covered one.
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

// Returns the point at distances sqrt(wa), sqrt(wb), sqrt(wc) from three centres a, b, c, relative to a. b and c are
// relative to a, too. The point is on the side of cross(b, c) if side is +1, and on the other side if it is -1. h2:
// squared height over the plane of the centres; a negative one counts as zero for the point.
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
