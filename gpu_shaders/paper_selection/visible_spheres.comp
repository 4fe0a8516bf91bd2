// SPDX-License-Identifier: BSD-3-Clause
// Stage "paper selection", 1: draws the vdW spheres. An atom is visible if the centre of some pixel shows it. Pass 0
// finds the nearest sphere of each pixel, pass 1 marks its atom.
// Reads: balls, pixel_depths. Writes: pixel_depths (bits of floats), visible, drawn. One group per atom. Overflow:
// none.
// Based on: Krone, Dachsbacher & Ertl 2010, section 3.2.
#version 450 core
layout(local_size_x = 32) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/paper_selection/pixel_ray.glsl"
#include "gpu_shaders/shared/parameters.glsl"

layout(std430, binding = 0) readonly buffer Balls { vec4 balls[]; };  // relative to the middle of the atoms, SAS radius
layout(std430, binding = 1) buffer PixelDepths { uint pixel_depths[]; };
layout(std430, binding = 2) writeonly buffer Visible { uint visible[]; };
layout(std430, binding = 3) writeonly buffer Drawn { uint drawn[]; };
layout(std140, binding = 0) uniform Parameters { DrawParameters params; };

void main() {
  uint a = linear_group_index();
  if (a >= params.count) return;
  vec3 v = view_from_molecule(balls[a].xyz);
  float radius = balls[a].w - params.probe_radius;
  PixelRange range = pixels_of(v, radius);
  for (int n = int(gl_LocalInvocationID.x); n < range.size.x * range.size.y; n += 32) {
    ivec2 pixel = pixel_of(range, n);
    PixelRay ray = pixel_ray(pixel);
    vec3 to_center = v - ray.origin;
    float along = dot(to_center, ray.direction);
    vec3 aside = to_center - ray.direction * along;
    float square = radius * radius - dot(aside, aside);
    if (square < 0.0) continue;
    float depth = along - sqrt(square);
    if (depth <= 0.0) continue;
    if (params.pass == 0u) {
      atomicMin(pixel_depths[pixel_index(pixel)], floatBitsToUint(depth));
    } else if (pixel_depths[pixel_index(pixel)] == floatBitsToUint(depth)) {
      visible[a] = 1u;
      drawn[a] = 1u;
    }
  }
}
