// SPDX-License-Identifier: BSD-3-Clause
// Stage "paper selection", 4 and 5: pass 0 adds the faces adjacent to visible ones, which are at the other ends of
// their edges; pass 1 keeps the edges of all selected faces and marks their atoms.
// Reads: arcs, probes, face_table, visible atoms. Writes: selected, kept_arcs, drawn atoms, counters. One invocation
// per arc. Overflow: none, kept_arcs has room for all arcs.
// Based on: Krone, Dachsbacher & Ertl 2010, section 3.3: the adjacent face is the one at the smallest angle about the
// edge, which is where the exposed arc ends.
#version 450 core
layout(local_size_x = 64) in;
#define DOUBLE_PRECISION
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/shared/parameters.glsl"
#include "gpu_shaders/geometry/triple.glsl"
#include "gpu_shaders/paper_selection/face_table.glsl"

layout(binding = 0) uniform usamplerBuffer arcs;  // i, j, begin_by, end_by
layout(std430, binding = 0) buffer Selected { uint selected[]; };  // per face: 1 visible, 2 adjacent to a visible one
layout(std430, binding = 1) readonly buffer Visible { uint visible[]; };
layout(std430, binding = 4) writeonly buffer KeptArcs { uvec4 kept_arcs[]; };
layout(std430, binding = 5) writeonly buffer Drawn { uint drawn[]; };
layout(std430, binding = 6) buffer Counters { uint arc_count_kept; };

uint face_at(uvec4 arc, bool at_end) {
  Triple t = triple_at(arc.x, arc.y, at_end ? arc.w : arc.z, at_end);
  return find_face(uvec4(t.a, t.b, t.c, t.side));
}

void keep(uvec4 arc) {
  kept_arcs[atomicAdd(arc_count_kept, 1u)] = arc;
  drawn[arc.x] = 1u;
  drawn[arc.y] = 1u;
}

void main() {
  uint index = linear_invocation_index();
  if (index >= params.count) return;
  uvec4 arc = texelFetch(arcs, int(index));
  if (arc.z == kNone) {
#if PASS == 1
    if (visible[arc.x] + visible[arc.y] > 0u) keep(arc);
#endif
    return;
  }
  uint first = face_at(arc, false);
  uint last = face_at(arc, true);
#if PASS == 0
  if (selected[first] == 1u) atomicCompSwap(selected[last], 0u, 2u);
  if (selected[last] == 1u) atomicCompSwap(selected[first], 0u, 2u);
#else
  if (selected[first] + selected[last] > 0u) keep(arc);
#endif
}
