// SPDX-License-Identifier: BSD-3-Clause
// Stage "paper selection", 3: fills the table that finds RS faces by their atoms.
// Reads: probes. Writes: face_table (0 before). One invocation per probe. Overflow: none.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/shared/parameters.glsl"
#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/geometry/triple.glsl"
#include "gpu_shaders/paper_selection/face_table.glsl"

void main() {
  uint face = linear_invocation_index();
  if (face < params.count) insert_face(face);
}
