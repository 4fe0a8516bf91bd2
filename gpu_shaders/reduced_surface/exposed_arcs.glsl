// SPDX-License-Identifier: BSD-3-Clause
// Contour build-up in a kernel: geometry/contour.glsl with a list of arcs that does not grow.
#include "gpu_shaders/geometry/circle.glsl"

// More arcs than this on one circle are left to the host, as doubtful circles are. Real structures show up to five.
const uint kArcCapacity = 8u;

// Circles whose squared radius is smaller than this many roundings of the ball's are in doubt as a whole: half an angle's
// digits are lost on them.
const real kSmallestCircle = real(65536);

ExposedArc exposed_arcs[kArcCapacity];

bool hold_arcs(uint count) { return count <= kArcCapacity; }

#include "gpu_shaders/geometry/contour.glsl"
