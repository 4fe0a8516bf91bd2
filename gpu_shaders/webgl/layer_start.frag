#version 300 es
// SPDX-License-Identifier: BSD-3-Clause
// Initializes the search of each ray for layers of a cut or translucent surface.
#define LAYERS 1
#include "gpu_shaders/webgl/scene.glsl"

layout(location = 0) out uvec4 over;   // blended colour of the layers so far: linear, premultiplied, as bits
layout(location = 1) out uvec4 state;  // see scene.glsl

void main() {
  PixelRay ray = pixel_ray(ivec2(gl_FragCoord.xy));
  KeptPart kept = kept_part(ray.p, ray.d, ray.eye_t);
  over = uvec4(0u);
  state = uvec4(floatBitsToUint(kept.from), floatBitsToUint(0.0), kept.to <= kept.from ? kEnded : 0u, 0u);
}
