// SPDX-License-Identifier: BSD-3-Clause
// Completes primitives: computes the bound relative to the camera, and appends to the tables of the ray caster.
// This file must be included where real is double. Numbers are computed in double precision and rounded once, as by
// core/render/ray_cast_pack.cpp on the host.
#include "gpu_shaders/geometry/patch_bounds.glsl"
#include "gpu_shaders/ray_cast/records.glsl"
#include "gpu_shaders/shared/parameters.glsl"

layout(std430, binding = 2) writeonly buffer Primitives { Primitive primitives[]; };
layout(std430, binding = 3) writeonly buffer Rows { vec4 rows[]; };
layout(std430, binding = 4) buffer Counters {
  uint primitive_count;
  uint row_count;
  uint cut_short;    // loops_cut_short()
  uint probe_count;  // read only
};
layout(std140, binding = kPrimitiveBinding) uniform PrimitiveBlock { PrimitiveParameters scene; };

uint next_row;

void add_row(dvec3 v, double w) {
  if (next_row < scene.row_capacity) rows[next_row] = vec4(vec3(v), float(w));
  ++next_row;
}

void add_bits(dvec3 v, uint bits) {
  if (next_row < scene.row_capacity) rows[next_row] = vec4(vec3(v), uintBitsToFloat(bits));
  ++next_row;
}

// Begins a primitive: sets the bound of its record, and reserves its rows. Returns false if no part of the bound is in
// front of the camera.
bool begin_primitive(PatchBound bound, uint row_count_of_it, out Primitive primitive) {
  SeenBound seen = see_bound(bound, double(scene.slack), scene.pivot, scene.camera_position, scene.camera_forward,
                             scene.eye_distance, scene.orthographic != 0u);
  if (!seen.in_front) return false;
  primitive.bound = vec4(vec3(seen.center), float(seen.radius));
  primitive.nearest = float(seen.nearest);
  next_row = atomicAdd(row_count, row_count_of_it);
  primitive.first_row = next_row;
  primitive.patch_index = 0u;
  primitive.second_atom = kNoPrimitive;
  return true;
}

void append_primitive(Primitive primitive) {
  uint slot = atomicAdd(primitive_count, 1u);
  if (slot < scene.primitive_capacity) primitives[slot] = primitive;
}
