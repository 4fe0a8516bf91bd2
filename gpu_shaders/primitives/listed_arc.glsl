// SPDX-License-Identifier: BSD-3-Clause
// Finds the entry of an invocation in the lists of arcs around atoms. There is one invocation per arc and side.
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/shared/parameters.glsl"

layout(binding = 0) uniform usamplerBuffer atom_arc_first;
layout(binding = 1) uniform usamplerBuffer atom_arcs;  // partner, begin_by, end_by, and a mark after partners.comp
layout(binding = 2) uniform usamplerBuffer arcs;       // i, j, begin_by, end_by
layout(std430, binding = 1) readonly buffer Rank { uvec2 rank[]; };  // places of each arc in the lists of i and j
layout(std430, binding = 2) buffer Clips { uint clips[]; };
layout(std430, binding = 3) readonly buffer ArcCount { uint arc_count; };
layout(std140, binding = 0) uniform Parameters { ArcParameters params; };

struct ListedArc {
  uint atom;
  uint place;  // index into the lists
  uint first;  // begin of the atom's list
  uint last;   // end of the atom's list
};

// Finds the entry of this invocation. Returns false after the last arc, and if the clips of the atom's patch are not
// `clipped`.
bool find_listed_arc(uint clipped, out ListedArc listed) {
  uint index = linear_invocation_index();
  if (index >= 2u * min(arc_count, params.arc_count)) return false;
  uint arc = index / 2u, side = index % 2u;
  listed.atom = texelFetch(arcs, int(arc))[side];
  if (clips[listed.atom] != clipped) return false;
  listed.first = texelFetch(atom_arc_first, int(listed.atom)).x;
  listed.last = texelFetch(atom_arc_first, int(listed.atom) + 1).x;
  listed.place = listed.first + rank[arc][side];
  return true;
}
