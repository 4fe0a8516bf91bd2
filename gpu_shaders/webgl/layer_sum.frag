#version 300 es
// SPDX-License-Identifier: BSD-3-Clause
// Blends finished translucent layers over the finished opaque layer, and adds the result to earlier samples.
#define LAYERS 1
#include "gpu_shaders/webgl/tables.glsl"
#include "gpu_shaders/look/parameters.glsl"

uniform usampler2D over_texels;
uniform usampler2D first_texels;    // colour and opacity of the first visible layer
uniform usampler2D front_texels;    // this layer, finished as if it were opaque
uniform usampler2D ink_texels;      // share of this layer that lines cover
uniform usampler2D behind_texels;   // the finished opaque layer
uniform usampler2D sum_texels;      // sums of earlier samples
layout(std140) uniform Parameters { FinishParameters params; };
layout(location = 0) out uvec4 sum;  // bits of floats

#include "gpu_shaders/look/seen_through.glsl"

float opacity_of_first(ivec2 pixel) {
  bool inside = all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, textureSize(first_texels, 0)));
  return inside ? uintBitsToFloat(texelFetch(first_texels, pixel, 0)).a : 0.0;
}

// Returns the opacity of a line next to the first visible layer, which is the greatest opacity of that layer nearby.
float opacity_nearby(ivec2 pixel) {
  int reach = int(ceil(0.5 * params.widest_line + 0.5));
  float nearby = 0.0;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) nearby = max(nearby, opacity_of_first(pixel + ivec2(x, y)));
  return nearby;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 over = uintBitsToFloat(texelFetch(over_texels, pixel, 0));
  vec4 first = uintBitsToFloat(texelFetch(first_texels, pixel, 0));
  vec4 front = uintBitsToFloat(texelFetch(front_texels, pixel, 0));
  float ink = uintBitsToFloat(texelFetch(ink_texels, pixel, 0).x);
  if (first.a > 0.0)
    over = with_finished_front(over, first, front);
  else if (ink > 0.0)
    over = under_ink(over, ink * opacity_nearby(pixel));
  vec4 color = over + (1.0 - over.a) * uintBitsToFloat(texelFetch(behind_texels, pixel, 0));
  if (params.sample_index != 0u) color += uintBitsToFloat(texelFetch(sum_texels, pixel, 0));
  sum = floatBitsToUint(color);
}
