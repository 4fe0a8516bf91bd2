// SPDX-License-Identifier: BSD-3-Clause
// Contour build-up: finds the arcs of a circle of two balls that other balls leave exposed.
// Based on: Totrov & Abagyan 1996.
//
// This file is written in the common subset of GLSL and C++, and is included after circle.glsl. The exposed part of the
// circle is kept in variables: globals of a kernel, or members of a C++ struct that has this file as its body
// (core/reduced_surface/contour/contour.h). The includer defines kUnitRoundoff and
//   ExposedArc get_arc(uint n)            which returns an arc of a list, and
//   bool set_arc(uint n, ExposedArc arc)  which stores an arc there or after the last one; false if there is no room.

Circle contour_circle;
real contour_weight;    // weight of the circle's first ball
real contour_noise;     // half_plane_noise() of the circle
real contour_unit;      // assumed relative error of numbers: the unit roundoff or more
uint exposed_count;     // number of exposed arcs
bool exposed_whole;     // true if the whole circle is exposed
bool exposed_doubtful;  // true if rounding could have changed a decision; later decisions are still made
real exposed_error;     // bound on the error of all end points so far

GEOMETRY void begin_contour(Circle c, real first_weight, real unit) {
  contour_circle = c;
  contour_weight = first_weight;
  contour_unit = unit;
  contour_noise = half_plane_noise(c, unit);
  exposed_count = 0u;
  exposed_whole = true;
  exposed_doubtful = false;
  exposed_error = real(0);
}

GEOMETRY void cover_everything() {
  exposed_count = 0u;
  exposed_whole = false;
}

GEOMETRY bool contour_is_covered() { return !exposed_whole && exposed_count == 0u; }

GEOMETRY bool contour_ended() { return exposed_doubtful || contour_is_covered(); }

GEOMETRY void expose_arc(ExposedArc arc) {
  if (set_arc(exposed_count, arc)) ++exposed_count;
  else exposed_doubtful = true;
}

// Removes a covered arc from the exposed part of the circle.
GEOMETRY void cover_arc(CoveredArc covered, uint label) {
  exposed_error = max(exposed_error, covered.error);
  if (exposed_whole) {
    exposed_whole = false;
    expose_arc(exposed_arc(covered.end, covered.begin, label, label));
    return;
  }
  uint kept = 0u;
  bool split = false;  // at most one arc is split
  ExposedArc second = exposed_arc(real(0), real(0), label, label);
  for (uint n = 0u; n < exposed_count; ++n) {
    ExposedArc arc = get_arc(n);
    real margin;
    int change = cut_arc(arc, covered, label, second, margin);
    if (!(margin > real(2) * exposed_error + real(16) * kUnitRoundoff)) exposed_doubtful = true;
    if (change == kSplit) split = true;
    if (change != kRemove) set_arc(kept++, arc);
  }
  exposed_count = kept;
  if (split) expose_arc(second);
}

// Removes the part that a half-plane covers, which must cut the circle.
GEOMETRY void cover(HalfPlane h, uint label) { cover_arc(covered_arc(h), label); }

// Removes the part that a ball covers from the exposed part of the circle.
GEOMETRY void block(Blocker ball, uint label) {
  real offset;
  if (surely_apart(contour_circle, contour_weight, contour_noise, ball.center, ball.square, ball.distance, ball.half_power,
                   kUnitRoundoff, offset)) {
    if (offset < real(0)) cover_everything();
    return;
  }
  HalfPlane h = covered_half_plane(contour_circle, contour_weight, ball.center, ball.distance, ball.weight, contour_unit);
  real margin;
  int meeting = meet_circle(h, margin);
  if (!(margin > real(0))) exposed_doubtful = true;
  if (meeting == kCovers) cover_everything();
  else if (meeting == kCuts) cover(h, label);
}
