// SPDX-License-Identifier: BSD-3-Clause
// Stage "paper selection", 2: draws the RS faces that have a visible atom. A face is visible if the centre of some
// pixel shows it. Pass 0 finds the nearest face of each pixel, pass 1 marks it.
// Reads: probes, balls, visible atoms, pixel_depths. Writes: pixel_depths (bits of floats), selected. One group per
// probe. Overflow: none.
// Based on: Krone, Dachsbacher & Ertl 2010, section 3.3.
#version 450 core
layout(local_size_x = 32) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/shared/parameters.glsl"
#include "gpu_shaders/paper_selection/pixel_ray.glsl"

layout(std430, binding = 0) readonly buffer Balls { vec4 balls[]; };  // relative to the middle of the atoms
layout(std430, binding = 1) buffer PixelDepths { uint pixel_depths[]; };
layout(std430, binding = 2) readonly buffer Visible { uint visible[]; };
layout(std430, binding = 3) readonly buffer Probes { ProbeRecord probes[]; };
layout(std430, binding = 4) writeonly buffer Selected { uint selected[]; };
layout(std140, binding = 0) uniform Parameters { DrawParameters params; };

// Returns the distance along the ray to the triangle a, b, c, which is not positive if the ray misses it (Moeller &
// Trumbore 1997).
float triangle_depth(PixelRay ray, vec3 a, vec3 b, vec3 c) {
  vec3 ab = b - a;
  vec3 ac = c - a;
  vec3 p = cross(ray.direction, ac);
  float determinant = dot(ab, p);
  vec3 to_origin = ray.origin - a;
  vec3 q = cross(to_origin, ab);
  float u = dot(to_origin, p) / determinant;
  float w = dot(ray.direction, q) / determinant;
  return u >= 0.0 && w >= 0.0 && u + w <= 1.0 ? dot(ac, q) / determinant : 0.0;
}

void main() {
  uint s = linear_group_index();
  if (s >= params.count) return;
  uvec3 atom = probes[s].atoms.xyz;
  if (visible[atom.x] + visible[atom.y] + visible[atom.z] == 0u) return;
  vec3 a = view_from_molecule(balls[atom.x].xyz);
  vec3 b = view_from_molecule(balls[atom.y].xyz);
  vec3 c = view_from_molecule(balls[atom.z].xyz);
  vec3 middle = (a + b + c) / 3.0;
  float reach = max(length(a - middle), max(length(b - middle), length(c - middle)));
  PixelRange range = pixels_of(middle, reach);
  for (int n = int(gl_LocalInvocationID.x); n < range.size.x * range.size.y; n += 32) {
    ivec2 pixel = pixel_of(range, n);
    float depth = triangle_depth(pixel_ray(pixel), a, b, c);
    if (!(depth > 0.0)) continue;
    if (params.pass == 0u) atomicMin(pixel_depths[pixel_index(pixel)], floatBitsToUint(depth));
    else if (pixel_depths[pixel_index(pixel)] == floatBitsToUint(depth)) selected[s] = 1u;
  }
}
