// SPDX-License-Identifier: BSD-3-Clause
// The end of every primitive's making: its bound seen from the camera, its place in the ray caster's tables.
// To be included where real is double. Numbers are made in double and rounded once, as core/render/ray_cast_scene.cpp
// does on the host.
#include "gpu_shaders/geometry/patch_bounds.glsl"
#include "gpu_shaders/ray_cast/records.glsl"

layout(std430, binding = 2) writeonly buffer Primitives { Primitive primitives[]; };
layout(std430, binding = 3) writeonly buffer Rows { vec4 rows[]; };
layout(std430, binding = 4) buffer Counters { uint primitive_count; uint row_count; uint cut_short; };  // cut_short: loop_guard.glsl
uniform uint primitive_capacity;
uniform uint row_capacity;
uniform dvec3 pivot;
uniform dvec3 camera_position;
uniform dvec3 camera_forward;
uniform double eye_distance;  // from the camera to the pivot
uniform uint camera_orthographic;
uniform float slack;

uint next_row;

void add_row(dvec3 v, double w) {
  if (next_row < row_capacity) rows[next_row] = vec4(vec3(v), float(w));
  ++next_row;
}

void add_bits(dvec3 v, uint bits) {
  if (next_row < row_capacity) rows[next_row] = vec4(vec3(v), uintBitsToFloat(bits));
  ++next_row;
}

// False when nothing of the bound lies in front of the camera; else sets the record's bound, and room for its rows.
bool begin_primitive(PatchBound bound, uint row_count_of_it, out Primitive primitive) {
  double radius = bound.radius * (1.0LF + 1e-6LF) + 4.0LF * double(slack);
  dvec3 center = bound.center - pivot;
  double depth = eye_distance + dot(center, camera_forward);
  if (depth + radius <= 0.0LF) return false;
  double distance = camera_orthographic != 0u ? depth : length(bound.center - camera_position);
  primitive.bound = vec4(vec3(center), float(radius));
  primitive.nearest = float((distance - radius) - 1e-6LF * (abs(distance) + radius));
  next_row = atomicAdd(row_count, row_count_of_it);
  primitive.first_row = next_row;
  primitive.patch_index = 0u;
  primitive.second_atom = kNoPrimitive;
  return true;
}

void append_primitive(Primitive primitive) {
  uint slot = atomicAdd(primitive_count, 1u);
  if (slot < primitive_capacity) primitives[slot] = primitive;
}
