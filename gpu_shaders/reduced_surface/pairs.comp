// SPDX-License-Identifier: BSD-3-Clause
// Stage "pairs": lists every overlapping pair i < j once as (entry of i, place of j in the neighbour list).
// Reads: neighbor_first, neighbor_labels, pair_first. Writes: pairs. One invocation per atom of the batch. Overflow:
// scans stop at the capacity; the host makes the frame again.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/reduced_surface/listed_balls.glsl"
#include "gpu_shaders/shared/parameters.glsl"

layout(std430, binding = 0) readonly buffer NeighborFirst { uint neighbor_first[]; };
layout(std430, binding = 1) readonly buffer NeighborLabels { uint neighbor_labels[]; };
layout(std430, binding = 2) readonly buffer PairFirst { uint pair_first[]; };
layout(std430, binding = 3) writeonly buffer Pairs { uvec2 pairs[]; };
layout(std140, binding = 0) uniform Parameters { PairParameters params; };

void main() {
  uint entry = linear_invocation_index();
  if (entry >= params.entry_count) return;
  uint i = ball_of(params.first_entry + entry);
  uint next = pair_first[entry];
  uint past = pair_first[entry + 1u];
  for (uint n = neighbor_first[entry]; n < neighbor_first[entry + 1u]; ++n)
    if (neighbor_labels[n] > i && is_listed(neighbor_labels[n]) && next < past)
      pairs[next++] = uvec2(params.first_entry + entry, n);
}
