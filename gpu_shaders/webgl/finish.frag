#version 300 es
// SPDX-License-Identifier: BSD-3-Clause
// A sample in the shade, in the air and under the lines, added to those before.
#include "gpu_shaders/webgl/sample_texels.glsl"

uniform usampler2D sample_texels;      // points.frag's colours
uniform usampler2D what_texels;        // points.frag's atoms and marks
uniform usampler2D visibility_texels;  // there for AMBIENT_OCCLUSION
uniform usampler2D sum_texels;         // of the samples before
layout(std140) uniform Parameters { FinishParameters params; };
layout(location = 0) out uvec4 sum;  // as bits

float visibility_at(ivec2 pixel) { return uintBitsToFloat(texelFetch(visibility_texels, pixel, 0).x); }

int mark_at(ivec2 pixel) { return int(texelFetch(what_texels, pixel, 0).z); }

#include "gpu_shaders/ray_cast/sheen.glsl"
#include "gpu_shaders/look/finish.glsl"
#include "gpu_shaders/look/finished_sample.glsl"

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 color = finished_sample(uintBitsToFloat(texelFetch(sample_texels, pixel, 0)), pixel, depth_at(pixel));
  if (params.sample_index != 0u) color += uintBitsToFloat(texelFetch(sum_texels, pixel, 0));
  sum = floatBitsToUint(color);
}
