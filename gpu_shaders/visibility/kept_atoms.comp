// SPDX-License-Identifier: BSD-3-Clause
// Stage "visible atoms", 3: keeps the atoms that can matter for a pixel (theorem 2). Pass 0 marks them in `before`;
// pass 1 (after a scan) lists them, ascending.
// Reads: balls, balls_low, tile_depths, block_depths. Writes: before, kept. One invocation per atom. Overflow: none.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/visibility/begins_in_front.glsl"

layout(std430, binding = 0) readonly buffer Balls { vec4 balls[]; };         // relative to the atoms' middle, SAS radius
layout(std430, binding = 1) readonly buffer BallsLow { vec4 balls_low[]; };  // w: 1 if swallowed
layout(std430, binding = 2) buffer Before { uint before[]; };
layout(std430, binding = 3) writeonly buffer Kept { uint kept[]; };
layout(std140, binding = 0) uniform Parameters { VisibleAtomsParameters params; };

void main() {
  uint a = linear_invocation_index();
  if (a >= params.atom_count) return;
#if PASS == 0
  // Every point that any probe touching the atom can make or cut is within r + 2p of the atom.
  bool needed = balls_low[a].w < 0.5 && begins_in_front(balls[a].xyz, balls[a].w + params.probe_radius);
  before[a] = needed ? 1u : 0u;
#else
  if (before[a + 1u] != before[a]) kept[before[a]] = a;
#endif
}
