#version 300 es
// SPDX-License-Identifier: BSD-3-Clause
// Blends the next event on each ray behind the earlier layers, and writes where the search continues.
#define LAYERS 1
#include "gpu_shaders/webgl/layer_texels.glsl"

uniform usampler2D over_texels;
layout(location = 0) out uvec4 over;   // see layer_start.frag
layout(location = 1) out uvec4 state;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  LayerEvent event = layer_event(pixel);
  over = texelFetch(over_texels, pixel, 0);
  state = event.state;
  if (!event.is_before_shapes) {
    state.z |= kEnded;
    return;
  }
  state.z |= kHasBegun;
  if (event.shows) state.z |= kHasShown;
  if (event.opacity >= 1.0 || event.is_last) state.z |= kEnded;
  if (!event.is_cap) {
    state.xy = uvec2(floatBitsToUint(event.t), floatBitsToUint(event.side));
    state.z |= kHasHit;
  }
  if (event.opacity >= 1.0) return;
  vec4 before = uintBitsToFloat(over);
  over = floatBitsToUint(before + (1.0 - before.a) * event.opacity * vec4(event.color, 1.0));
}
