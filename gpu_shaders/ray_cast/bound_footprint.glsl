// SPDX-License-Identifier: BSD-3-Clause
// Computes the rectangle of pixels, and of tiles, that a bounding sphere may touch. It may be slightly too large, but
// never too small. This file is written in GLSL and, as the body of a struct, in C++ (core/render/cpu). It must be
// included after the block `params` of TileListParameters.
#ifndef MENISCUS_RAY_CAST_BOUND_FOOTPRINT_GLSL
#define MENISCUS_RAY_CAST_BOUND_FOOTPRINT_GLSL
#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/shared/tangent_slopes.glsl"

// Returns the range of tiles [low, high) along one axis.
ivec2 tile_range(vec2 pixels, int tile_count) {
  // Samples may lie anywhere in a pixel, so half a pixel more on each side is sufficient.
  vec2 edge = floor((pixels + vec2(-0.5, 0.5)) / float(kTileEdge)) + vec2(0.0, 1.0);
  return ivec2(clamp(edge, vec2(0.0), vec2(float(tile_count))));
}

// Returns the rectangle in pixels as (x_low, x_high, y_low, y_high). The lower bounds exceed the upper ones if nothing
// is in front of the camera.
vec4 bound_pixels(vec4 bound) {
  float x = dot(vec3(bound), params.right);
  float y = -dot(vec3(bound), params.up);
  float z = params.eye_distance + dot(vec3(bound), params.forward);
  float radius = bound.w + 1e-6 * (bound.w + length(vec3(bound)));
  if (z + radius + 1e-6 * params.eye_distance < 0.0) return vec4(1.0, 0.0, 1.0, 0.0);
  vec2 slopes_x = vec2(x - radius, x + radius);
  vec2 slopes_y = vec2(y - radius, y + radius);
  float scale = params.pixels_per_angstrom;
  if (params.orthographic == 0u) {
    slopes_x = tangent_slopes(x, z, radius);
    slopes_y = tangent_slopes(y, z, radius);
    scale *= params.eye_distance;
  }
  return vec4(params.block_center.x + slopes_x * scale, params.block_center.y + slopes_y * scale);
}

// Returns the rectangle of tiles as (x_low, x_high, y_low, y_high) without the upper bounds. It is empty if nothing is
// in front of the camera.
ivec4 bound_footprint(vec4 bound) {
  vec4 pixels = bound_pixels(bound);
  if (pixels.x > pixels.y) return ivec4(0);
  return ivec4(tile_range(vec2(pixels.x, pixels.y), params.tiles.x),
               tile_range(vec2(pixels.z, pixels.w), params.tiles.y));
}

#endif
