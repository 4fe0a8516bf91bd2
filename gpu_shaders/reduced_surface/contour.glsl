// SPDX-License-Identifier: BSD-3-Clause
// Contour build-up of one circle in a kernel: what core/reduced_surface/contour/contour.cpp does on the host, arc by arc.
// Based on: Totrov & Abagyan 1996.
#include "gpu_shaders/geometry/circle.glsl"

struct ExposedArc {
  real begin;  // pseudo-angles
  real end;
  uint begin_by;
  uint end_by;
};

// More arcs than this on one circle are left to the host, as doubtful circles are. Real structures show up to five.
const uint kArcCapacity = 8u;

// Circles whose squared radius is smaller than this many roundings of the ball's are in doubt as a whole. Rounding moves
// what a ball covers of them by up to its share of this, and block() leaves it 0.001 Å.
const real kSmallestCircle = real(65536);

ExposedArc exposed_arcs[kArcCapacity];
uint exposed_count;
bool exposed_whole;
bool exposed_doubtful;
real exposed_error;  // of any end point so far

void begin_contour() {
  exposed_count = 0u;
  exposed_whole = true;
  exposed_doubtful = false;
  exposed_error = real(0);
}

void cover_everything() {
  exposed_count = 0u;
  exposed_whole = false;
}

bool contour_ended() { return exposed_doubtful || (!exposed_whole && exposed_count == 0u); }

// Takes away what a cutting half-plane covers.
void cover(HalfPlane h, uint label) {
  CoveredArc covered = covered_arc(h);
  exposed_error = max(exposed_error, covered.error);
  ExposedArc rest = ExposedArc(covered.end, covered.begin, label, label);
  if (exposed_whole) {
    exposed_whole = false;
    exposed_arcs[0] = rest;
    exposed_count = 1u;
    return;
  }
  // At most one arc is split by one half-plane; its second part joins after the loop.
  uint kept = 0u;
  bool split = false;
  ExposedArc second = rest;
  for (uint n = 0u; n < exposed_count; ++n) {
    ExposedArc arc = exposed_arcs[n];
    real margin;
    int change = clip_arc(arc.begin, arc.end, covered, margin);
    if (!(margin > real(2) * exposed_error + real(16) * kUnitRoundoff)) exposed_doubtful = true;
    if (change == kRemove) continue;
    if (change == kComplement) arc = rest;
    if (change == kSplit) {
      split = true;
      second = arc;
      second.begin = covered.end;
      second.begin_by = label;
    }
    if (change == kCutBegin) {
      arc.begin = covered.end;
      arc.begin_by = label;
    }
    if (change == kCutEnd || change == kSplit) {
      arc.end = covered.begin;
      arc.end_by = label;
    }
    exposed_arcs[kept++] = arc;
  }
  if (split) {
    if (kept < kArcCapacity) exposed_arcs[kept++] = second;
    else exposed_doubtful = true;
  }
  exposed_count = kept;
}

// One ball against what is left of the circle c around a first ball of weight w0.
void block(Circle c, real w0, real3 q, real wq, uint label) {
  // Most balls miss the circle or cover all of it; that needs no half-plane.
  real qq = dot(q, q);
  real along = dot(c.axis, q);
  real offset = ((w0 + qq - wq) * real(0.5) - c.height * along) * c.inverse_radius;
  real clear = (qq - along * along) * real(1.001) + real(0.001);
  if (offset * offset > clear) {
    if (offset < real(0)) cover_everything();
    return;
  }
  HalfPlane h = covered_half_plane(c, w0, q, sqrt(qq), wq, kUnitRoundoff);
  real margin;
  int meeting = meet_circle(h, margin);
  if (!(margin > real(0))) exposed_doubtful = true;
  else if (meeting == kCovers) cover_everything();
  else if (meeting == kCuts) cover(h, label);
}
