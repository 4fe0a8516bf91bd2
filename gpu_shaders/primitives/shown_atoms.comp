// SPDX-License-Identifier: BSD-3-Clause
// Stage "primitives", 4: marks the convex patches that may be visible.
// Reads: kept atoms, radii, depths. Writes: clips (zeros before). One invocation per kept atom. Overflow: none.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/reduced_surface/listed_balls.glsl"
#include "gpu_shaders/shared/parameters.glsl"
#include "gpu_shaders/visibility/begins_in_front.glsl"

layout(std430, binding = 0) readonly buffer Atoms { dvec4 atoms[]; };   // centre, decision weight
layout(std430, binding = 1) readonly buffer Radii { double radii[]; };  // van der Waals
layout(std430, binding = 2) writeonly buffer Clips { uint clips[]; };
layout(std140, binding = 0) uniform Parameters { ConvexParameters params; };

void main() {
  uint entry = linear_invocation_index();
  if (entry >= min(params.entry_count, entries_of(params.atom_count))) return;
  uint a = ball_of(entry);
  // The patch lies on the vdW sphere itself.
  if (begins_in_front(vec3(atoms[a].xyz - params.middle), float(radii[a]))) clips[a] = kByPartners;
}
