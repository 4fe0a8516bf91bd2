// SPDX-License-Identifier: BSD-3-Clause
// Computes the visibility of the sky and of the lamp for each hit of a block, and stores it with the depth of the hit.
#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
#include "gpu_shaders/look/block_texels.glsl"
#include "gpu_shaders/look/parameters.glsl"

layout(binding = 2) uniform usamplerBuffer light_texels;
layout(std430, binding = 0) writeonly buffer Shade { vec4 shade[]; };  // visibilities, depth

layout(std140, binding = 0) uniform Parameters { LightMapParameters maps; };

int light_texel(int at) { return int(texelFetch(light_texels, at).x); }

#include "gpu_shaders/look/light_maps.glsl"

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (!in_block(pixel)) return;
  float depth = depth_at(pixel);
  vec2 seen = vec2(1.0);
  if (depth != kNothing) {
    vec3 p = position_at(pixel, depth);
    vec3 normal = facing(hit_normal_at(pixel), to_viewer_at(p));
    if (maps.sky_axes > 0) seen.x = sky_visibility(p, normal, pixel.y);
    if (maps.lamp_places > 0) seen.y = lamp_visibility(p, normal, pixel.y);
  }
  shade[index_of(pixel)] = vec4(seen, depth, 0.0);
}
