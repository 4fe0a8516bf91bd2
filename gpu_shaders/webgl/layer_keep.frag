#version 300 es
// SPDX-License-Identifier: BSD-3-Clause
// Keeps the next event on a ray if it is the first visible one (FIRST), or otherwise if it is opaque.
#define LAYERS 1
#include "gpu_shaders/webgl/layer_texels.glsl"

uniform usampler2D normal_texels;  // written by points.frag
uniform usampler2D what_texels;
layout(location = 0) out uvec4 color;   // alpha with FIRST: the opacity, or 0 if it is 1; otherwise 1
layout(location = 1) out uvec4 normal;
layout(location = 2) out uvec4 what;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  LayerEvent event = layer_event(pixel);
  if (!event.is_before_shapes || !event.shows) discard;
#ifdef FIRST
  if ((event.state.z & kHasShown) != 0u) discard;
  color = floatBitsToUint(event.opacity < 1.0 ? vec4(event.color, event.opacity) : vec4(0.0));
#else
  if (event.opacity < 1.0) discard;
  color = floatBitsToUint(vec4(event.color, 1.0));
#endif
  normal = texelFetch(normal_texels, pixel, 0);
  what = texelFetch(what_texels, pixel, 0);
}
