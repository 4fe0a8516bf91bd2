#version 300 es
// SPDX-License-Identifier: BSD-3-Clause
// Finds the next event on each ray: the hit that cast.frag has found, or the cap before it. If the ray leaves the solid
// at the next hit behind a plane, it is in the solid at the plane, so there is a cap.
#define LAYERS 1
#include "gpu_shaders/webgl/scene.glsl"

uniform usampler2D found_texels;  // written by cast.frag
uniform usampler2D state_texels;
uniform float seen_through;            // 1: caps are seen from within, too
layout(location = 0) out uvec4 event;  // t as bits; primitive, kOnPlane or kNoPrimitive; plane; facing as bits

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uvec2 met = texelFetch(found_texels, pixel, 0).xy;
  uvec4 state = texelFetch(state_texels, pixel, 0);
  event = uvec4(floatBitsToUint(kMiss), kNoPrimitive, kNoPlane, 0u);
  if (met.y == kNoPrimitive || (state.z & kEnded) != 0u) return;
  PixelRay ray = pixel_ray(pixel);
  KeptPart kept = kept_part(ray.p, ray.d, ray.eye_t);
  float t = uintBitsToFloat(met.x);
  float side = dot(surface_point(load_primitive(met.y), ray.p + ray.d * t).normal, ray.d);
  if ((state.z & kHasBegun) == 0u && kept.from_plane != kNoPlane && side > 0.0)
    event = uvec4(floatBitsToUint(kept.from), kOnPlane, kept.from_plane, floatBitsToUint(-1.0));
  else if (t < kept.to)
    event = uvec4(met.x, met.y, kNoPlane, floatBitsToUint(side));
  else if (seen_through > 0.0 && side > 0.0)
    event = uvec4(floatBitsToUint(kept.to), kOnPlane, kept.to_plane, floatBitsToUint(1.0));
}
