// SPDX-License-Identifier: BSD-3-Clause
// Stage "fixed probes": places the fixed probes (RS faces) that the view needs, which are visible or cut visible
// patches.
// Reads: arcs, atoms, radii, kept atoms, depths. Writes: probes, probe_balls, probe_balls_low, counters. One invocation
// per arc. Overflow: appends stop at the capacity but go on counting; the host grows and runs again.
// Based on: Krone, Dachsbacher & Ertl 2010, section 3.3 (visible and adjacent RS faces), but selected by theorem 2.
#version 450 core
layout(local_size_x = 64) in;
#define DOUBLE_PRECISION
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/reduced_surface/arc_ends.glsl"
#include "gpu_shaders/reduced_surface/listed_balls.glsl"
#include "gpu_shaders/shared/parameters.glsl"
#include "gpu_shaders/visibility/begins_in_front.glsl"

layout(std430, binding = 2) writeonly buffer Probes { ProbeRecord probes[]; };
layout(std430, binding = 3) writeonly buffer ProbeBalls { vec4 probe_balls[]; };  // relative to the atoms' middle, p
layout(std430, binding = 4) writeonly buffer ProbeBallsLow { vec4 probe_balls_low[]; };  // rounding error of the centre
layout(std430, binding = 5) buffer Counters {
  uint probe_count;
  uint end_sums[6];  // sums of two keys over the ends of arcs, by the place of the third atom among the sorted three
};
layout(std430, binding = 6) readonly buffer ArcCount { uint arc_count; };
layout(std140, binding = 0) uniform Parameters { FixedProbeParameters params; };

void append(Triple t) {
  FixedProbe probe = place_probe(t, params.probe_radius);
  dvec3 from_middle = probe.position - params.middle;
  vec3 coarse = vec3(from_middle);
  // Everything that a probe makes or cuts is within its radius p.
  if (!begins_in_front(coarse, float(params.probe_radius))) return;
  uint slot = atomicAdd(probe_count, 1u);
  if (slot >= params.probe_capacity) return;
  probes[slot] = ProbeRecord(probe.position, probe.height, uvec4(t.a, t.b, t.c, t.side),
                             triple_key(t, 0u), uint[3](0u, 0u, 0u));
  probe_balls[slot] = vec4(coarse, float(params.probe_radius));
  probe_balls_low[slot] = vec4(vec3(from_middle - dvec3(coarse)), 0.0);
}

void main() {
  uint index = linear_invocation_index();
  if (index >= min(arc_count, params.arc_count)) return;
  uvec4 arc = texelFetch(arcs, int(index));
  if (arc.z == kNone) return;
  for (int end = 0; end < 2; ++end) {
    uint k = end == 1 ? arc.w : arc.z;
    // The view needs no probe that touches an atom which the view does not need.
    if (!is_listed(k)) continue;
    Triple t = triple_at(arc.x, arc.y, k, end == 1);
    // Three arcs end at every probe, and each of its atoms is the third atom of one of them. The certificate of closure
    // (theorem 3) is that the sums of keys over these three kinds of ends are equal.
    uint role = role_of_third(arc.x, arc.y, k);
    atomicAdd(end_sums[2u * role], triple_key(t, 0u));
    atomicAdd(end_sums[2u * role + 1u], triple_key(t, 0x9e6c63d0u));
    if (role == 0u) append(t);
  }
}
