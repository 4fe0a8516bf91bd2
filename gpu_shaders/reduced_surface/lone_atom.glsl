// SPDX-License-Identifier: BSD-3-Clause
// Whether an atom's SAS ball meets no other. To be included behind the buffers `atoms` (centre, decision weight),
// `neighbor_first` and `neighbor_labels`, and geometry/circle.glsl in double precision.
#ifndef MENISCUS_LONE_ATOM_GLSL
#define MENISCUS_LONE_ATOM_GLSL

// Neighbours are listed generously; only balls that really overlap keep an atom from being alone.
bool alone(uint a, uint entry) {
  for (uint n = neighbor_first[entry]; n < neighbor_first[entry + 1u]; ++n) {
    dvec4 other = atoms[neighbor_labels[n]];
    if (balls_overlap(other.xyz - atoms[a].xyz, atoms[a].w, other.w)) return false;
  }
  return true;
}

#endif
