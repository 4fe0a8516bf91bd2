// SPDX-License-Identifier: BSD-3-Clause
// A hash table with linear probing that finds the RS face of a triple of atoms.
// This file must be included after triple.glsl.
#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/shared/parameters.glsl"

layout(std430, binding = 2) buffer FaceTable { uint face_table[]; };  // face + 1, or 0 if the place is empty
layout(std430, binding = 3) readonly buffer Probes { ProbeRecord probes[]; };
layout(std140, binding = 0) uniform Parameters { FaceTableParameters params; };

uint table_place(uvec4 triple) {
  return add_to_key(add_to_key(add_to_key(triple.w, triple.x), triple.y), triple.z) & (params.table_size - 1u);
}

void insert_face(uint face) {
  uint place = table_place(probes[face].atoms);
  while (atomicCompSwap(face_table[place], 0u, face + 1u) != 0u) place = (place + 1u) & (params.table_size - 1u);
}

uint find_face(uvec4 triple) {
  for (uint place = table_place(triple); face_table[place] != 0u; place = (place + 1u) & (params.table_size - 1u))
    if (probes[face_table[place] - 1u].atoms == triple) return face_table[place] - 1u;
  return kNone;
}
