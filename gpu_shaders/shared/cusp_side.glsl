// SPDX-License-Identifier: BSD-3-Clause
// One side of a fixed probe's spherical polygon, as core/surface/gpu/gpu_cusp_tracer.cpp uploads it (64 bytes, std430).
struct CuspSide {
  vec4 contact;        // xyz: unit vector from the probe to the side's first contact
  vec4 gap_direction;  // xyz: from the spindle circle's centre to the middle of the covered gap
  vec4 circle_center;  // xyz: relative to the probe
  uint circle;         // names the spindle circle; kNone if it is no spindle
  uint partner;        // probe across the gap
  uint touching;       // 1: the circle is exactly as large as the probe
  uint spare;
};
