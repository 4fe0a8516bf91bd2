#version 300 es
// SPDX-License-Identifier: BSD-3-Clause
// Computes the visibility of the sky and of the lamp at each point, and stores both with the depth of the point.
#include "gpu_shaders/webgl/sample_texels.glsl"

precision highp usampler2DArray;
uniform usampler2DArray light_texels;  // the maps one after another, in layers of 2048 x 256 texels
layout(std140) uniform Parameters { LightMapParameters maps; };
layout(location = 0) out uvec4 shade;  // visibilities, depth; as bits

int light_texel(int at) { return int(texelFetch(light_texels, ivec3(at & 2047, (at >> 11) & 255, at >> 19), 0).x); }

#include "gpu_shaders/look/light_maps.glsl"

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = depth_at(pixel);
  vec2 seen = vec2(1.0);
  if (depth != kNothing) {
    vec3 p = position_at(pixel, depth);
    vec3 normal = facing(hit_normal_at(pixel), to_viewer_at(p));
    if (maps.sky_axes > 0) seen.x = sky_visibility(p, normal, pixel.y);
    if (maps.lamp_places > 0) seen.y = lamp_visibility(p, normal, pixel.y);
  }
  shade = floatBitsToUint(vec4(seen, depth, 0.0));
}
