// SPDX-License-Identifier: BSD-3-Clause
// Stage "pairs": lists every overlapping pair i < j once, as (i, place of j in the neighbour list).
// Reads: neighbor_first, neighbor_labels, pair_first. Writes: pairs. One invocation per atom. Overflow: none.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/linear_index.glsl"

layout(std430, binding = 0) readonly buffer NeighborFirst { uint neighbor_first[]; };
layout(std430, binding = 1) readonly buffer NeighborLabels { uint neighbor_labels[]; };
layout(std430, binding = 2) readonly buffer PairFirst { uint pair_first[]; };
layout(std430, binding = 3) writeonly buffer Pairs { uvec2 pairs[]; };
uniform uint atom_count;

void main() {
  uint i = linear_invocation_index();
  if (i >= atom_count) return;
  uint next = pair_first[i];
  for (uint n = neighbor_first[i]; n < neighbor_first[i + 1u]; ++n)
    if (neighbor_labels[n] > i) pairs[next++] = uvec2(i, n);
}
