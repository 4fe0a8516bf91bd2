// SPDX-License-Identifier: BSD-3-Clause
// Computes the fixed probes at the ends of an arc in double precision. All arcs that end at a probe get the same
// position. This file must be included where real is double.
#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/geometry/circle.glsl"
#include "gpu_shaders/geometry/fixed_probe.glsl"
#include "gpu_shaders/geometry/triple.glsl"

layout(std430, binding = 0) readonly buffer Atoms { dvec4 atoms[]; };   // centre, decision weight
layout(std430, binding = 1) readonly buffer Radii { double radii[]; };  // van der Waals
layout(binding = 0) uniform usamplerBuffer arcs;                        // i, j, begin_by, end_by

double extended(uint atom, double probe_radius) { return radii[atom] + probe_radius; }

FixedProbe place_probe(Triple t, double probe_radius) {
  dvec3 origin = atoms[t.a].xyz;
  FixedProbe probe = fixed_probe(atoms[t.b].xyz - origin, atoms[t.c].xyz - origin, extended(t.a, probe_radius),
                                 extended(t.b, probe_radius), extended(t.c, probe_radius),
                                 t.side != 0u ? 1.0LF : -1.0LF);
  probe.position += origin;
  return probe;
}
