#version 300 es
// SPDX-License-Identifier: BSD-3-Clause
// Computes the visibility of the sky at each point, and stores it with the depth of the point.
#include "gpu_shaders/webgl/sample_texels.glsl"

uniform usampler2D map_texels;  // points.frag's normals and depths of the first sample
layout(std140) uniform Parameters { OcclusionParameters occlusion; };
layout(location = 0) out uvec4 shade;  // visibility, depth; as bits

// Returns the depth of a texel of the map, or kNothing outside of the map.
float map_depth_or_nothing(ivec2 texel) {
  if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, occlusion.map_size))) return kNothing;
  return uintBitsToFloat(texelFetch(map_texels, texel, 0).w);
}

#include "gpu_shaders/webgl/occlusion.glsl"

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = depth_at(pixel);
  shade = floatBitsToUint(vec4(depth == kNothing ? 1.0 : sky_visibility(pixel, depth), depth, 0.0, 0.0));
}
