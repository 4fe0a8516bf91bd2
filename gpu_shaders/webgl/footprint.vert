#version 300 es
// SPDX-License-Identifier: BSD-3-Clause
// Makes the rectangle of pixels that a primitive's bound may touch, at the depth where the bound begins. The top row of
// the picture is the lowest row of the target.
#include "gpu_shaders/webgl/tables.glsl"

TileListParameters params;  // parameters of the only block, which is the whole picture
#include "gpu_shaders/ray_cast/bound_footprint.glsl"

in uint primitive;  // number of the primitive or, with BALLS, of an atom
#ifdef BALLS
uniform usampler2D ball_texels;  // centre, radius
uniform float probe;             // Å by which the balls are enlarged here
#endif
uniform vec2 depth_range;  // distances from the eye at which depths begin and end, Å
flat out uint index;
flat out vec4 bound;  // sphere in the coordinates of the records

void main() {
  params.right = view.right;
  params.eye_distance = view.eye_distance;
  params.up = view.up;
  params.pixels_per_angstrom = 1.0 / view.pixel_size;
  params.forward = view.forward;
  params.orthographic = view.orthographic;
  params.block_center = 0.5 - view.first_offset;
  index = primitive;
#ifdef BALLS
  bound = uintBitsToFloat(entry(ball_texels, primitive)) + vec4(0.0, 0.0, 0.0, probe);
#else
  bound = uintBitsToFloat(entry(primitive_texels, 3u * primitive));
#endif
  vec3 center = bound.xyz - pivot;
  vec4 pixels = bound_pixels(vec4(center, bound.w));
  float depth = view.orthographic != 0u ? view.eye_distance + dot(center, view.forward)
                                        : length(center + view.forward * view.eye_distance);
  float nearest = depth - bound.w - 1e-5 * depth;
  float z = clamp((nearest - depth_range.x) / (depth_range.y - depth_range.x), 0.0, 1.0);
  vec2 x = clamp(2.0 * (pixels.xy + vec2(-0.5, 0.5)) / float(view.size.x) - 1.0, -1.0, 1.0);
  vec2 y = clamp(2.0 * (pixels.zw + vec2(-0.5, 0.5)) / float(view.size.y) - 1.0, -1.0, 1.0);
  bool shown = pixels.x <= pixels.y;
  vec2 corner = vec2((gl_VertexID & 1) == 0 ? x.x : x.y, (gl_VertexID & 2) == 0 ? y.x : y.y);
  gl_Position = shown ? vec4(corner, 2.0 * z - 1.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
