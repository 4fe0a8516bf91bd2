// SPDX-License-Identifier: BSD-3-Clause
// Contour build-up in a kernel: geometry/contour.glsl with a list of arcs that does not grow.
#include "gpu_shaders/geometry/circle.glsl"

// More arcs than this on one circle are left to the host, as doubtful circles are. Real structures show up to five.
const uint kArcCapacity = 8u;

// Circles whose squared radius is smaller than this many roundings of the ball's are in doubt as a whole: half an angle's
// digits are lost on them.
const real kSmallestCircle = real(65536);

#ifdef DOUBLE_PRECISION
// As bits: NVIDIA's compiler (580.159) rounds doubles to floats in arrays with a variable index.
uvec4 exposed_ends[kArcCapacity];
uvec2 exposed_labels[kArcCapacity];

ExposedArc get_arc(uint n) {
  return exposed_arc(packDouble2x32(exposed_ends[n].xy), packDouble2x32(exposed_ends[n].zw), exposed_labels[n].x,
                     exposed_labels[n].y);
}

bool set_arc(uint n, ExposedArc arc) {
  if (n >= kArcCapacity) return false;
  exposed_ends[n] = uvec4(unpackDouble2x32(arc.begin), unpackDouble2x32(arc.end));
  exposed_labels[n] = uvec2(arc.begin_by, arc.end_by);
  return true;
}
#else
ExposedArc exposed_arcs[kArcCapacity];

ExposedArc get_arc(uint n) { return exposed_arcs[n]; }

bool set_arc(uint n, ExposedArc arc) {
  if (n >= kArcCapacity) return false;
  exposed_arcs[n] = arc;
  return true;
}
#endif

#include "gpu_shaders/geometry/contour.glsl"
