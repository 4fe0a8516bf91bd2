// SPDX-License-Identifier: BSD-3-Clause
// Contour build-up in a kernel: geometry/contour.glsl with a list of arcs of fixed capacity.
#include "gpu_shaders/geometry/circle.glsl"

// Circles with more arcs than this are left to the host, like doubtful circles. Real structures have up to five.
const uint kArcCapacity = 8u;

// A circle is in doubt as a whole if its squared radius is less than this many roundings of the ball's squared radius,
// because half of the digits of angles are lost on it.
const real kSmallestCircle = real(65536);

#ifdef DOUBLE_PRECISION
// The ends are stored as bits, because NVIDIA's compiler (580.159) rounds doubles to floats in arrays with a variable
// index.
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
