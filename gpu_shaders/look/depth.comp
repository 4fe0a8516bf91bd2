// SPDX-License-Identifier: BSD-3-Clause
// Computes the depths of the hits of a block along the view axis, packed for the many fetches that follow.
#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
#include "gpu_shaders/look/block_texels.glsl"
#include "gpu_shaders/look/parameters.glsl"
#include "gpu_shaders/ray_cast/records.glsl"

layout(binding = 2) uniform usamplerBuffer atom_marks;  // bound if has_marks
layout(std430, binding = 0) writeonly buffer Depths { float depths[]; };
layout(std430, binding = 1) writeonly buffer Marks { uint marks[]; };

layout(std140, binding = 0) uniform Parameters { DepthParameters params; };

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (!in_block(pixel)) return;
  int at = index_of(pixel);
  float t = uintBitsToFloat(texelFetch(hit_texels, 2 * at).w);
  float depth = kNothing;
  uvec4 what = texelFetch(hit_texels, 2 * at + 1);
  if (what.x != kNoPrimitive) {
    // Rays begin at the pivot's plane. A perspective ray is longer than its component along the axis.
    vec2 slope = (view.first_offset + vec2(pixel) + view.sample_offset) * view.pixel_size / view.eye_distance;
    depth = view.eye_distance + (view.orthographic != 0u ? t : t / sqrt(1.0 + dot(slope, slope)));
  }
  depths[at] = depth;
  if (params.has_marks != 0u) marks[at] = what.x != kNoPrimitive ? texelFetch(atom_marks, int(what.y)).x : 0u;
}
