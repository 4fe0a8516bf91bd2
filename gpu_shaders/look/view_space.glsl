// SPDX-License-Identifier: BSD-3-Clause
// Points of a cast block in the camera's axes: x right, y up, z towards the viewer, the eye (orthographic: its plane)
// at 0.
#ifndef MENISCUS_LOOK_VIEW_SPACE_GLSL
#define MENISCUS_LOOK_VIEW_SPACE_GLSL
#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/ray_cast/parameters.glsl"

layout(binding = 0) uniform usamplerBuffer hit_texels;  // two texels each: struct Hit of ray_cast/records.glsl
layout(binding = 1) uniform usamplerBuffer depth_texels;

layout(std140, binding = kBlockViewBinding) uniform ViewBlock { BlockView view; };

int index_of(ivec2 pixel) { return pixel.y * view.size.x + pixel.x; }

bool in_block(ivec2 pixel) { return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, view.size)); }

// Along the view axis, in Å.
float depth_at(ivec2 pixel) { return uintBitsToFloat(texelFetch(depth_texels, index_of(pixel)).x); }

// Å across one pixel at this depth.
float pixel_size_at(float depth) {
  return view.orthographic != 0u ? view.pixel_size : view.pixel_size * (depth / view.eye_distance);
}

vec3 position_at(ivec2 pixel, float depth) {
  vec2 offset = (view.first_offset + vec2(pixel) + view.sample_offset) * pixel_size_at(depth);
  return vec3(offset.x, -offset.y, -depth);
}

// Towards the viewer's side, whichever side of the surface that is.
vec3 normal_at(ivec2 pixel, vec3 to_viewer) {
  vec3 normal = uintBitsToFloat(texelFetch(hit_texels, 2 * index_of(pixel)).xyz);
  vec3 n = vec3(dot(normal, view.right), dot(normal, view.up), -dot(normal, view.forward));
  return dot(n, to_viewer) < 0.0 ? -n : n;
}

vec3 to_viewer_at(vec3 position) { return view.orthographic != 0u ? vec3(0.0, 0.0, 1.0) : -normalize(position); }

#endif
