// SPDX-License-Identifier: BSD-3-Clause
// Stage "neighbors", last: lists the atoms that are exposed as a whole, for no other SAS ball meets theirs.
// Reads: atoms, atoms_low, neighbour lists. Writes: lone_atoms, counters. One invocation per atom of the batch.
// Overflow: appends stop at the capacity but go on counting; the host grows and runs again.
#version 450 core
layout(local_size_x = 64) in;
#define DOUBLE_PRECISION
#include "gpu_shaders/shared/linear_index.glsl"
#include "gpu_shaders/reduced_surface/listed_balls.glsl"
#include "gpu_shaders/reduced_surface/parameters.glsl"
#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/geometry/circle.glsl"

layout(std430, binding = 0) readonly buffer Atoms { dvec4 atoms[]; };        // centre, decision weight
layout(std430, binding = 1) readonly buffer AtomsLow { vec4 atoms_low[]; };  // w: 1 if swallowed
layout(std430, binding = 2) readonly buffer NeighborFirst { uint neighbor_first[]; };
layout(std430, binding = 3) readonly buffer NeighborLabels { uint neighbor_labels[]; };
layout(std430, binding = 4) writeonly buffer LoneAtoms { uint lone_atoms[]; };
layout(std430, binding = 5) buffer Counters { uint lone_count; };
layout(std140, binding = 0) uniform Parameters { LoneAtomParameters params; };
#include "gpu_shaders/reduced_surface/lone_atom.glsl"

void main() {
  uint entry = linear_invocation_index();
  if (entry >= params.entry_count) return;
  uint a = ball_of(params.first_entry + entry);
  if (atoms_low[a].w > 0.5) return;
  if (!alone(a, entry)) return;  // no loop guard: kernel "neighbors" went through more
  uint slot = atomicAdd(lone_count, 1u);
  if (slot < params.capacity) lone_atoms[slot] = a;
}
