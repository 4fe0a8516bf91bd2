// SPDX-License-Identifier: BSD-3-Clause
// Stage "primitives", 3: lists the arcs around every atom. Pass 0 counts them; pass 1 (after a scan) fills the lists.
// Reads: arcs. Writes: atom_arc_first (counts, then scanned), rank, atom_arcs. One invocation per arc. Overflow: none.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/shared/parameters.glsl"

layout(binding = 0) uniform usamplerBuffer arcs;  // i, j, begin_by, end_by
layout(std430, binding = 0) buffer AtomArcFirst { uint atom_arc_first[]; };
layout(std430, binding = 1) buffer Rank { uvec2 rank[]; };  // places of each arc in the lists of i and j
layout(std430, binding = 2) writeonly buffer AtomArcs { uvec4 atom_arcs[]; };  // partner, begin_by, end_by, 0
layout(std430, binding = 3) readonly buffer ArcCount { uint arc_count; };
layout(std140, binding = 0) uniform Parameters { ArcParameters params; };

void main() {
  uint index = linear_invocation_index();
  if (index >= min(arc_count, params.arc_count)) return;
  uvec4 arc = texelFetch(arcs, int(index));
#if PASS == 0
  rank[index] = uvec2(atomicAdd(atom_arc_first[arc.x], 1u), atomicAdd(atom_arc_first[arc.y], 1u));
#else
  atom_arcs[atom_arc_first[arc.x] + rank[index].x] = uvec4(arc.yzw, 0u);
  // An arc runs in the opposite direction when seen from the other atom.
  atom_arcs[atom_arc_first[arc.y] + rank[index].y] = uvec4(arc.xwz, 0u);
#endif
}
