// SPDX-License-Identifier: BSD-3-Clause
// Fetches the next event on a ray with its colour, and tests if it is in front of the opaque shapes that are drawn in
// addition to the surface.
#ifndef MENISCUS_WEBGL_LAYER_TEXELS_GLSL
#define MENISCUS_WEBGL_LAYER_TEXELS_GLSL
#include "gpu_shaders/webgl/scene.glsl"

uniform usampler2D event_texels;  // written by layer_event.frag
uniform usampler2D state_texels;
uniform usampler2D sample_texels;  // points.frag's colours of the events; alpha: opacity
uniform usampler2D shape_texels;   // points.frag's `what` of the shapes

struct LayerEvent {
  bool is_before_shapes;  // false: there is no event, or a shape hides it
  bool is_cap;
  bool is_last;  // true if planes keep nothing behind it
  bool shows;    // true if it is not hidden
  float t;
  float side;  // below 0 where the ray enters the solid
  vec3 color;
  float opacity;
  uvec4 state;
};

LayerEvent layer_event(ivec2 pixel) {
  uvec4 texel = texelFetch(event_texels, pixel, 0);
  vec4 color = uintBitsToFloat(texelFetch(sample_texels, pixel, 0));
  LayerEvent event;
  event.state = texelFetch(state_texels, pixel, 0);
  event.t = uintBitsToFloat(texel.x);
  event.side = uintBitsToFloat(texel.w);
  event.is_cap = texel.y == kOnPlane;
  event.is_last = event.is_cap && event.side > 0.0;
  event.is_before_shapes =
      texel.y != kNoPrimitive && event.t < uintBitsToFloat(texelFetch(shape_texels, pixel, 0).w);
  event.color = color.rgb;
  event.opacity = color.a;
  event.shows = event.opacity > 0.0;
  return event;
}

#endif
