// SPDX-License-Identifier: BSD-3-Clause
// The rectangle of tiles that a bounding sphere may touch; a little too large rather than too small.
#ifndef MENISCUS_RAY_CAST_BOUND_FOOTPRINT_GLSL
#define MENISCUS_RAY_CAST_BOUND_FOOTPRINT_GLSL

const float kTileEdge = 16.0;  // pixels

uniform vec2 block_center;   // the picture's centre in pixels of the block
uniform float pixels_per_angstrom;  // on the pivot's plane
uniform ivec2 tiles;         // columns and rows of the block
uniform float eye_distance;  // from the camera's position to the pivot's plane, in Å
uniform uint orthographic;
uniform vec3 right;
uniform vec3 up;
uniform vec3 forward;

// Slopes x/z of the two lines through the eye that touch the circle around (x, z), widened by what rounding may do.
vec2 tangent_slopes(float x, float z, float radius) {
  // Close to the eye the difference below would lose its digits, and the circle fills the picture anyway.
  if (z < 1.01 * radius) return vec2(-1e20, 1e20);
  float denominator = (z - radius) * (z + radius);
  float root = radius * sqrt(x * x + denominator);
  float margin = 1e-6 * (1.0 + z / (z - radius)) * (abs(x) * z + root);
  return vec2(x * z - root - margin, x * z + root + margin) / denominator;
}

// Tiles [low, high) along one axis.
ivec2 tile_range(vec2 pixels, int tile_count) {
  // A pixel's samples reach to its borders: half a pixel more on each side is plenty.
  vec2 edge = floor((pixels + vec2(-0.5, 0.5)) / kTileEdge) + vec2(0.0, 1.0);
  return ivec2(clamp(edge, vec2(0.0), vec2(float(tile_count))));
}

// x and y of the rectangle [low, high) as (x_low, x_high, y_low, y_high); empty if nothing is in front of the camera.
ivec4 bound_footprint(vec4 bound) {
  float x = dot(bound.xyz, right);
  float y = -dot(bound.xyz, up);
  float z = eye_distance + dot(bound.xyz, forward);
  float radius = bound.w + 1e-6 * (bound.w + length(bound.xyz));
  if (z + radius + 1e-6 * eye_distance < 0.0) return ivec4(0);
  vec2 slopes_x = vec2(x - radius, x + radius);
  vec2 slopes_y = vec2(y - radius, y + radius);
  float scale = pixels_per_angstrom;
  if (orthographic == 0u) {
    slopes_x = tangent_slopes(x, z, radius);
    slopes_y = tangent_slopes(y, z, radius);
    scale *= eye_distance;
  }
  return ivec4(tile_range(block_center.x + slopes_x * scale, tiles.x),
               tile_range(block_center.y + slopes_y * scale, tiles.y));
}

#endif
