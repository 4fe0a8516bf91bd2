// SPDX-License-Identifier: BSD-3-Clause
// Stage "grid": sorts atoms into cells. Pass 0 counts the atoms of each cell; pass 1 (after a scan) fills the cells.
// Reads: atoms. Writes: cell_first (counts, then scanned), rank, cell_atoms. One invocation per atom. Overflow: none,
// every array has its final size.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/reduced_surface/cell_grid.glsl"

layout(std430, binding = 0) readonly buffer Atoms { vec4 atoms[]; };  // relative to the molecule's middle, SAS radius
layout(std430, binding = 1) buffer CellFirst { uint cell_first[]; };
layout(std430, binding = 2) buffer Rank { uint rank[]; };
layout(std430, binding = 3) writeonly buffer CellAtoms { uint cell_atoms[]; };
layout(std430, binding = 4) readonly buffer BallCount { uint cut_short; uint ball_count; };
layout(std140, binding = 0) uniform Parameters { GridParameters params; };

void main() {
  uint a = linear_invocation_index();
  if (a >= min(ball_count, params.atom_count)) return;
  uint cell = cell_index(cell_of(atoms[a].xyz));
#if PASS == 0
  rank[a] = atomicAdd(cell_first[cell], 1u);
#else
  cell_atoms[cell_first[cell] + rank[a]] = a;
#endif
}
