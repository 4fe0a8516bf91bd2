// SPDX-License-Identifier: BSD-3-Clause
// How much of the sky each hit of a block sees.
#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
#include "gpu_shaders/look/block_texels.glsl"
#include "gpu_shaders/look/parameters.glsl"

layout(std430, binding = 0) writeonly buffer Visibility { float visibility[]; };

layout(std140, binding = 0) uniform Parameters { OcclusionParameters occlusion; };

#include "gpu_shaders/look/occlusion.glsl"

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (!in_block(pixel)) return;
  float depth = depth_at(pixel);
  visibility[index_of(pixel)] = depth == kNothing ? 1.0 : sky_visibility(pixel, depth);
}
