// SPDX-License-Identifier: BSD-3-Clause
// Blends sums of samples over a background, as sRGB (IEC 61966-2-1) in 8 bits.
#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
#include "gpu_shaders/look/parameters.glsl"

layout(std430, binding = 0) readonly buffer Picture { vec4 picture[]; };  // sums of linear, premultiplied samples
layout(rgba8, binding = 0) uniform writeonly image2D presented;

layout(std140, binding = 0) uniform Parameters { PresentParameters params; };

#include "gpu_shaders/look/srgb.glsl"

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, params.size))) return;
  vec4 color = picture[pixel.y * params.size.x + pixel.x] * params.per_sample;
  imageStore(presented, pixel, vec4(srgb_from_linear(color.rgb + params.background * (1.0 - color.a)), 1.0));
}
