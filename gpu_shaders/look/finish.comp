// SPDX-License-Identifier: BSD-3-Clause
// Applies shade, depth cueing and silhouettes to one sample of each pixel of a block, and adds it to the picture.
// SHADE and SILHOUETTES are defined only if they are requested, because software GL would compute them
// always.
#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
#include "gpu_shaders/look/block_texels.glsl"
#include "gpu_shaders/look/parameters.glsl"

layout(binding = 2) uniform usamplerBuffer shade_texels;  // visibilities, depth; bound for SHADE
layout(binding = 3) uniform usamplerBuffer mark_texels;   // mark of each pixel; bound if has_marks
layout(std430, binding = 0) readonly buffer Samples { vec4 samples[]; };  // linear, premultiplied
layout(std430, binding = 1) buffer Picture { vec4 picture[]; };

layout(std140, binding = 0) uniform Parameters { FinishParameters params; };

vec2 visibility_at(ivec2 pixel) { return uintBitsToFloat(texelFetch(shade_texels, index_of(pixel)).xy); }

float shade_depth_or_nothing(ivec2 pixel) {
  return in_block(pixel) ? uintBitsToFloat(texelFetch(shade_texels, index_of(pixel)).z) : kNothing;
}

vec3 shade_seen_at(ivec2 pixel, float depth) { return seen_at(place_of(pixel), depth, pixel_size_at(depth)); }

int mark_at(ivec2 pixel) { return int(texelFetch(mark_texels, index_of(pixel)).x); }

#include "gpu_shaders/ray_cast/studio_light.glsl"
#include "gpu_shaders/look/finish.glsl"

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (!in_block(pixel)) return;
  int at = index_of(pixel);
  vec4 color = finished_sample(samples[at], pixel, depth_at(pixel));
  picture[at] = params.sample_index == 0u ? color : picture[at] + color;
}
