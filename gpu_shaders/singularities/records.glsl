// SPDX-License-Identifier: BSD-3-Clause
// Data that the host and the kernels of this stage exchange, for GLSL and C++ (core/gpu/kernel_records.h).
#ifndef MENISCUS_SINGULARITIES_RECORDS_GLSL
#define MENISCUS_SINGULARITIES_RECORDS_GLSL

// One side of a fixed probe's spherical polygon: struct CuspSide of core/surface/cusp_tracer.h in single precision.
struct SideRecord {
  vec4 contact;        // xyz: unit vector from the probe to the side's first contact
  vec4 gap_direction;  // xyz: from the spindle circle's centre to the middle of the covered gap
  vec4 circle_center;  // xyz: relative to the probe
  uint circle;         // number of the spindle circle; kNone if it is not a spindle
  uint partner;        // probe across the gap
  uint touching;       // 1 if the circle is exactly as large as the probe
  uint spare;
};

// An exposed arc of the circle of two probes: struct TracedArc of core/surface/cusp_tracer.h.
struct CuspArcRecord {
  uvec4 names;  // lower probe, higher probe, labels of the begin and of the end
  vec4 begin;   // xyz: unit vector from the circle's centre
  vec4 end;
};

#endif
