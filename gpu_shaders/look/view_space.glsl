// SPDX-License-Identifier: BSD-3-Clause
// Points of a cast block in the camera's axes: x right, y up, z towards the viewer, the eye (orthographic: its plane)
// at 0.
#ifndef MENISCUS_LOOK_VIEW_SPACE_GLSL
#define MENISCUS_LOOK_VIEW_SPACE_GLSL

const float kNothing = 3.0e38;  // depth where nothing is hit

layout(binding = 0) uniform usamplerBuffer hit_texels;  // two texels each: struct Hit of ray_cast/records.glsl
layout(binding = 1) uniform usamplerBuffer depth_texels;

uniform ivec2 size;          // of the block, in pixels
uniform vec2 first_offset;   // of the block's first pixel centre from the picture's centre, in pixels
uniform vec2 sample_offset;  // of the sample from the pixel's centre
uniform float pixel_size;    // on the pivot's plane, in Å
uniform float eye_distance;  // from the camera's position to the pivot's plane, in Å
uniform uint orthographic;
uniform vec3 right;
uniform vec3 up;
uniform vec3 forward;

int index_of(ivec2 pixel) { return pixel.y * size.x + pixel.x; }

bool in_block(ivec2 pixel) { return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, size)); }

// Along the view axis, in Å.
float depth_at(ivec2 pixel) { return uintBitsToFloat(texelFetch(depth_texels, index_of(pixel)).x); }

// Å across one pixel at this depth.
float pixel_size_at(float depth) { return orthographic != 0u ? pixel_size : pixel_size * (depth / eye_distance); }

vec3 position_at(ivec2 pixel, float depth) {
  vec2 offset = (first_offset + vec2(pixel) + sample_offset) * pixel_size_at(depth);
  return vec3(offset.x, -offset.y, -depth);
}

// Towards the viewer's side, whichever side of the surface that is.
vec3 normal_at(ivec2 pixel, vec3 to_viewer) {
  vec3 normal = uintBitsToFloat(texelFetch(hit_texels, 2 * index_of(pixel)).xyz);
  vec3 n = vec3(dot(normal, right), dot(normal, up), -dot(normal, forward));
  return dot(n, to_viewer) < 0.0 ? -n : n;
}

vec3 to_viewer_at(vec3 position) { return orthographic != 0u ? vec3(0.0, 0.0, 1.0) : -normalize(position); }

#endif
