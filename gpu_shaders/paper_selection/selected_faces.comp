// SPDX-License-Identifier: BSD-3-Clause
// Stage "paper selection", 6: keeps the selected RS faces.
// Reads: selected, probes, probe_balls, probe_balls_low. Writes: copies of the last three with the selected faces only,
// counters. One invocation per probe. Overflow: none, the copies have room for all faces.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/shared/parameters.glsl"

layout(std430, binding = 0) readonly buffer Selected { uint selected[]; };
layout(std430, binding = 1) readonly buffer ProbeBalls { vec4 probe_balls[]; };
layout(std430, binding = 2) readonly buffer ProbeBallsLow { vec4 probe_balls_low[]; };
layout(std430, binding = 3) readonly buffer Probes { ProbeRecord probes[]; };
layout(std430, binding = 4) writeonly buffer KeptBalls { vec4 kept_balls[]; };
layout(std430, binding = 5) writeonly buffer KeptBallsLow { vec4 kept_balls_low[]; };
layout(std430, binding = 6) writeonly buffer KeptProbes { ProbeRecord kept_probes[]; };
layout(std430, binding = 7) buffer Counters { uint probe_count_kept; };
layout(std140, binding = 0) uniform Parameters { FaceParameters params; };

void main() {
  uint s = linear_invocation_index();
  if (s >= params.probe_count || selected[s] == 0u) return;
  uint slot = atomicAdd(probe_count_kept, 1u);
  kept_balls[slot] = probe_balls[s];
  kept_balls_low[slot] = probe_balls_low[s];
  kept_probes[slot] = probes[s];
}
