// SPDX-License-Identifier: BSD-3-Clause
// Names patches by what they are rather than by where they stand, for rays that meet two of them at one distance.
//
// Common subset of GLSL and C++, see triple.glsl. Keys are made by add_to_key, from 0 on:
//   convex patch: its atom, and nothing is added;
//   concave patch: its contacts, counter-clockwise seen from the probe, the smallest first;
//   toroidal patch: its two atoms, then, unless it is free, the keys of the concave patches at its start and its end.
#ifndef MENISCUS_GEOMETRY_TIE_KEY_GLSL
#define MENISCUS_GEOMETRY_TIE_KEY_GLSL
#include "gpu_shaders/geometry/triple.glsl"

GEOMETRY uint add_to_key(uint key, uint value) {
  // The finalizer of MurmurHash3 (Appleby 2011) on the value, chained.
  uint h = (key * 31u) ^ (value + 0x9e3779b9u);
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  return h ^ (h >> 16);
}

// Names a fixed probe by its contacts, counter-clockwise seen from it; seed 0: as the ray caster names its patch.
GEOMETRY uint triple_key(Triple t, uint seed) {
  uint key = add_to_key(seed, t.a);
  key = add_to_key(key, t.side != 0u ? t.b : t.c);
  return add_to_key(key, t.side != 0u ? t.c : t.b);
}

#endif
