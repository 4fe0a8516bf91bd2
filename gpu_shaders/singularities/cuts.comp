// SPDX-License-Identifier: BSD-3-Clause
// Stage "cuts": decides which probes cut the spherical polygon of each low probe: flag 1 if they do, 0 if not, 2 in
// doubt.
// Reads: neighbour lists of probes, heads, sides. Writes: flags, one per list entry. One invocation per probe of the
// batch. Overflow: none.
// Based on: Krone, Dachsbacher & Ertl 2010, section 3.4 (singularity handling), with every probe within two radii.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/shared/parameters.glsl"
#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/geometry/polygon_reach.glsl"

layout(std430, binding = 0) readonly buffer NeighborFirst { uint neighbor_first[]; };
layout(std430, binding = 1) readonly buffer NeighborBalls { vec4 neighbor_balls[]; };
layout(std430, binding = 2) readonly buffer Heads { uvec2 heads[]; };  // first side of each probe, 1 if it is low
layout(std430, binding = 3) readonly buffer Sides { SideRecord sides[]; };
layout(std430, binding = 4) writeonly buffer Flags { uint flags[]; };
layout(std140, binding = 0) uniform Parameters { CutParameters params; };

// The margin within which single precision does not decide: about 60 roundings of a side's normal, magnified twentyfold
// where the root in reach_of_side() is taken of a twentieth.
const float kDoubt = 1e-4;

uint flag_of(uint first, uint past, vec3 toward) {
  float distance = length(toward);
  // For close probes a root near zero decides, for which single precision has no digits left.
  if (distance < 0.1 * params.probe_radius) return 2u;
  vec3 d = toward / distance;
  PolygonReach reach = no_reach();
  for (uint n = first; n < past; ++n)
    add_side(reach, sides[n].contact.xyz, sides[n + 1u == past ? first : n + 1u].contact.xyz, d);
  float margin = cut_reach(reach, params.probe_radius) - distance;
  if (abs(margin) < kDoubt * params.probe_radius || abs(reach.most_outside) < kDoubt) return 2u;
  return margin > 0.0 ? 1u : 0u;
}

void main() {
  uint entry = linear_invocation_index();
  if (entry >= params.probe_count) return;
  uvec2 head = heads[params.first_probe + entry];
  uint past = heads[params.first_probe + entry + 1u].x;
  for (uint n = neighbor_first[entry]; n < neighbor_first[entry + 1u]; ++n)
    flags[n] = head.y == 0u ? 0u : flag_of(head.x, past, neighbor_balls[n].xyz);
}
