// SPDX-License-Identifier: BSD-3-Clause
// The three atoms that a fixed probe touches, in the one order all arcs that end there agree on.
#include "gpu_shaders/ray_cast/tie_key.glsl"

const uint kNone = 0xffffffffu;

// The atoms of a fixed probe, ascending; side 1: it stands on the side of cross(b - a, c - a).
struct Triple {
  uint a;
  uint b;
  uint c;
  uint side;
};

// Where the covered part of the circle (i, j), i < j, ends by k, the probe stands on the side of cross(j - i, k - i);
// where it begins, on the other.
Triple triple_at(uint i, uint j, uint k, bool at_end) {
  uint side = at_end ? 0u : 1u;
  if (k < i) return Triple(k, i, j, side);
  if (k < j) return Triple(i, k, j, side ^ 1u);
  return Triple(i, j, k, side);
}

// Names a fixed probe by its contacts, counter-clockwise seen from it; seed 0: as the ray caster names its patch.
uint triple_key(Triple t, uint seed) {
  uint key = add_to_key(seed, t.a);
  key = add_to_key(key, t.side != 0u ? t.b : t.c);
  return add_to_key(key, t.side != 0u ? t.c : t.b);
}
