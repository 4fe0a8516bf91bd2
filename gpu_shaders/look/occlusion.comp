// SPDX-License-Identifier: BSD-3-Clause
// Computes the visibility of the sky for each hit of a block, and stores it with the depth of the hit.
#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
#include "gpu_shaders/look/block_texels.glsl"
#include "gpu_shaders/look/parameters.glsl"

layout(binding = 2) uniform usamplerBuffer map_texels;
layout(std430, binding = 0) writeonly buffer Shade { vec2 shade[]; };  // visibility, depth

layout(std140, binding = 0) uniform Parameters { OcclusionParameters occlusion; };

// Returns the depth of a texel of the map, or kNothing outside of the map.
float map_depth_or_nothing(ivec2 texel) {
  if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, occlusion.map_size))) return kNothing;
  return uintBitsToFloat(texelFetch(map_texels, texel.y * occlusion.map_size.x + texel.x).x);
}

#include "gpu_shaders/look/occlusion.glsl"

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (!in_block(pixel)) return;
  float depth = depth_at(pixel);
  shade[index_of(pixel)] = vec2(depth == kNothing ? 1.0 : sky_visibility(pixel, depth), depth);
}
