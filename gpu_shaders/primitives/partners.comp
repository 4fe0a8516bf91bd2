// SPDX-License-Identifier: BSD-3-Clause
// Stage "primitives", 5: marks each atom on the arcs around an atom once in that atom's list.
// Reads: arcs, lists of arcs by atom. Writes: those lists with marks, clips. One invocation per arc and side, which
// traverses the list once. Overflow: none; if loops are cut short, all neighbours clip.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/primitives/listed_arc.glsl"

layout(std430, binding = 0) writeonly buffer MarkedArcs { uvec4 marked_arcs[]; };  // partner, begin_by, end_by, mark

void main() {
  ListedArc listed;
  if (!find_listed_arc(kByPartners, listed)) return;
  uvec3 arc = texelFetch(atom_arcs, int(listed.place)).xyz;
  bvec3 is_new = bvec3(true, arc.y != kNone, arc.z != kNone && arc.z != arc.y);
  for (uint n = listed.first; n < (is_new.y || is_new.z ? listed.last : listed.place); ++n) {
    uvec3 other = texelFetch(atom_arcs, int(n)).xyz;
    // Atoms at the ends of arcs have arcs, too, but perhaps none that the view needs.
    is_new.y = is_new.y && arc.y != other.x;
    is_new.z = is_new.z && arc.z != other.x;
    if (n < listed.place) {
      is_new.x = is_new.x && arc.x != other.x;
      is_new.y = is_new.y && arc.y != other.y && arc.y != other.z;
      is_new.z = is_new.z && arc.z != other.y && arc.z != other.z;
    }
  }
  marked_arcs[listed.place] = uvec4(arc, (is_new.x ? kOnCircle : 0u) | (is_new.y ? 2u : 0u) | (is_new.z ? 4u : 0u));
  if (loops_cut_short()) clips[listed.atom] = kByNeighbors;
}
