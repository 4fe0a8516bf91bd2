#version 300 es
// SPDX-License-Identifier: BSD-3-Clause
// Blends sums of samples over a background and converts them to sRGB. The canvas begins with the lowest row.
precision highp float;
precision highp int;
precision highp usampler2D;
#include "gpu_shaders/look/parameters.glsl"
#include "gpu_shaders/look/srgb.glsl"

uniform usampler2D sum_texels;
layout(std140) uniform Parameters { PresentParameters params; };
layout(location = 0) out vec4 presented;

void main() {
  ivec2 size = textureSize(sum_texels, 0);
  ivec2 pixel = ivec2(gl_FragCoord.xy) * size / params.size;
  vec4 color = uintBitsToFloat(texelFetch(sum_texels, ivec2(pixel.x, size.y - 1 - pixel.y), 0)) * params.per_sample;
  presented = vec4(srgb_from_linear(color.rgb + params.background * (1.0 - color.a)), 1.0);
}
