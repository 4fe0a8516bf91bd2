#version 300 es
// SPDX-License-Identifier: BSD-3-Clause
// Applies shade, depth cueing and lines to a sample, and adds it to earlier samples. With LAYERS the sample is opaque
// independently of its alpha, and the share that lines cover is written, too.
#include "gpu_shaders/webgl/sample_texels.glsl"

uniform usampler2D sample_texels;      // points.frag's colours
uniform usampler2D what_texels;        // points.frag's atoms and marks
uniform usampler2D shade_texels;       // written by light.frag; only with SHADE
uniform usampler2D sum_texels;         // sums of earlier samples
layout(std140) uniform Parameters { FinishParameters params; };
layout(location = 0) out uvec4 sum;  // bits of floats
#ifdef LAYERS
layout(location = 1) out uvec4 ink;
#endif

vec2 visibility_at(ivec2 pixel) { return uintBitsToFloat(texelFetch(shade_texels, pixel, 0).xy); }

float shade_depth_or_nothing(ivec2 pixel) {
  return in_block(pixel) ? uintBitsToFloat(texelFetch(shade_texels, pixel, 0).z) : kNothing;
}

vec3 shade_seen_at(ivec2 pixel, float depth) { return seen_at(place_of(pixel), depth, pixel_size_at(depth)); }

int mark_at(ivec2 pixel) { return int(texelFetch(what_texels, pixel, 0).z); }

#include "gpu_shaders/ray_cast/studio_light.glsl"
#include "gpu_shaders/look/finish.glsl"

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = depth_at(pixel);
  vec4 color = uintBitsToFloat(texelFetch(sample_texels, pixel, 0));
#ifdef LAYERS
  color.a = depth == kNothing ? 0.0 : 1.0;
  ink = uvec4(0u);
#ifdef SILHOUETTES
  Ink line = ink_on(pixel, depth);
  ink.x = floatBitsToUint(line.covered * clarity(line.depth));
#endif
#endif
  color = finished_sample(color, pixel, depth);
  if (params.sample_index != 0u) color += uintBitsToFloat(texelFetch(sum_texels, pixel, 0));
  sum = floatBitsToUint(color);
}
