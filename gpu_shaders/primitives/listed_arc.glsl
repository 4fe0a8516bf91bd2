// SPDX-License-Identifier: BSD-3-Clause
// One invocation per arc and side: an entry of the list of arcs around that side's atom.
#include "gpu_shaders/shared/linear_index.glsl"
#include "gpu_shaders/primitives/parameters.glsl"
#include "gpu_shaders/primitives/convex_clips.glsl"

layout(binding = 0) uniform usamplerBuffer atom_arc_first;
layout(binding = 1) uniform usamplerBuffer atom_arcs;  // partner, begin_by, end_by, and behind partners.comp a mark
layout(binding = 2) uniform usamplerBuffer arcs;       // i, j, begin_by, end_by
layout(std430, binding = 1) readonly buffer Rank { uvec2 rank[]; };  // of an arc in the lists of i and j
layout(std430, binding = 2) buffer Clips { uint clips[]; };
layout(std430, binding = 3) readonly buffer ArcCount { uint arc_count; };
layout(std140, binding = 0) uniform Parameters { ArcParameters params; };

struct ListedArc {
  uint atom;
  uint place;  // in the lists
  uint first;  // the atom's list
  uint last;
};

// False past the last arc, and where the clips of the atom's patch are not said to be this.
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
