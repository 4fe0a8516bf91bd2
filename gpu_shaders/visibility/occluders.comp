// SPDX-License-Identifier: BSD-3-Clause
// Stage "visible atoms", 1: draws the vdW spheres into blocks of pixels. Each block keeps a depth by which all of its
// rays have ended.
// Reads: balls. Writes: block_depths (bits of floats, filled with the bits of kNothing before). One group per atom.
// Overflow: none.
// Based on: Krone, Dachsbacher & Ertl 2010, section 3.2 (visible atoms), with blocks of rays instead of single ones.
#version 450 core
layout(local_size_x = 32) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/visibility/view.glsl"

layout(std430, binding = 0) readonly buffer Balls { vec4 balls[]; };  // relative to the middle of the atoms, SAS radius
layout(std430, binding = 1) buffer BlockDepths { uint block_depths[]; };
layout(std140, binding = 0) uniform Parameters { VisibleAtomsParameters params; };

void main() {
  uint a = linear_group_index();
  if (a >= params.atom_count) return;
  vec4 ball = balls[a];
  vec3 v = view_from_molecule(ball.xyz);
  float radius = ball.w - params.probe_radius;
  if (v.z <= 0.0) return;
  vec4 pixels = touched_pixels(v, radius);
  ivec2 low = ivec2(pixels.xy) / view.block_edge;
  ivec2 blocks = ivec2(pixels.zw) / view.block_edge - low + 1;
  int row_length = tile_count().x * (kTileEdge / view.block_edge);
  int row_count = tile_count().y * (kTileEdge / view.block_edge);
  for (int n = int(gl_LocalInvocationID.x); n < blocks.x * blocks.y; n += 32) {
    ivec2 block = low + ivec2(n % blocks.x, n / blocks.x);
    if (block.x >= row_length || block.y >= row_count) continue;
    float depth = latest_depth(ray_block(block * view.block_edge, view.block_edge), v, radius);
    // Positive floats have the same order as their bits.
    if (depth < kNothing) atomicMin(block_depths[block.y * row_length + block.x], floatBitsToUint(depth));
  }
}
