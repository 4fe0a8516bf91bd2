#version 300 es
// SPDX-License-Identifier: BSD-3-Clause
// Finds the atom whose sphere is nearest to each point of a cap. Each atom draws the ball in which it may be the
// nearest, and the nearest one wins by its depth. If two atoms are equally near, the one that is drawn first wins.
#define LAYERS 1
#include "gpu_shaders/webgl/scene.glsl"

uniform usampler2D event_texels;  // written by layer_event.frag
uniform float probe;              // Å: greatest distance of a cap from the nearest sphere
uniform float largest_ball;       // Å
flat in uint index;
flat in vec4 bound;  // the ball, larger by the probe
layout(location = 0) out uint atom;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uvec4 event = texelFetch(event_texels, pixel, 0);
  if (event.y != kOnPlane) discard;
  PixelRay ray = pixel_ray(pixel);
  float outside = length(ray.p + ray.d * uintBitsToFloat(event.x) - bound.xyz) - (bound.w - probe);
  atom = index;
  gl_FragDepth = clamp((outside + largest_ball) / (largest_ball + probe + 1.0), 0.0, 1.0);
}
