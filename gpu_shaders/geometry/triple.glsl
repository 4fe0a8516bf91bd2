// SPDX-License-Identifier: BSD-3-Clause
// Names the points where three balls meet, in an order on which all three arcs that end there agree. They are fixed
// probes (balls = SAS balls of atoms) or ends of cusp curves (balls = fixed probes). It also names patches, for rays
// that meet two of them at one distance.
//
// This file is written in the common subset of GLSL and C++; in C++ the includer provides uint.
#ifndef MENISCUS_GEOMETRY_TRIPLE_GLSL
#define MENISCUS_GEOMETRY_TRIPLE_GLSL

// Three balls in ascending order. side: 1 if the point is on the side of cross(b - a, c - a), 0 otherwise.
struct Triple {
  uint a;
  uint b;
  uint c;
  uint side;
};

GEOMETRY Triple triple_of(uint a, uint b, uint c, uint side) {
  Triple t;
  t.a = a;
  t.b = b;
  t.c = c;
  t.side = side;
  return t;
}

// Returns the triple at an end of an arc of the circle (i, j), i < j, that ball k covers from there on. The point where
// the part covered by k ends is on the side of cross(j - i, k - i), and the point where it begins is on the other side
// (covered_arc()). An arc ends where a covered part begins.
GEOMETRY Triple triple_at(uint i, uint j, uint k, bool at_end) {
  uint side = at_end ? 0u : 1u;
  if (k < i) return triple_of(k, i, j, side);
  if (k < j) return triple_of(i, k, j, side ^ 1u);
  return triple_of(i, j, k, side);
}

// Returns the place of k in the triple of the circle (i, j) and k: 0 for the last, 1 for the middle, 2 for the first.
GEOMETRY uint role_of_third(uint i, uint j, uint k) { return k > j ? 0u : k > i ? 1u : 2u; }

// Adds a value to a key. Keys name patches by their atoms rather than by their positions. They are made by
// add_to_key(), beginning with 0:
//   convex patch: its atom, and nothing is added;
//   concave patch: its contacts, counter-clockwise seen from the probe, the smallest first;
//   toroidal patch: its two atoms, then, unless it is free, the keys of the concave patches at its start and its end.
GEOMETRY uint add_to_key(uint key, uint value) {
  // The values are chained by the finalizer of MurmurHash3 (Appleby 2011).
  uint h = (key * 31u) ^ (value + 0x9e3779b9u);
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  return h ^ (h >> 16);
}

// Returns the key of a fixed probe from its contacts, counter-clockwise seen from the probe. For seed 0 it is the key
// of its patch in the ray caster.
GEOMETRY uint triple_key(Triple t, uint seed) {
  uint key = add_to_key(seed, t.a);
  key = add_to_key(key, t.side != 0u ? t.b : t.c);
  return add_to_key(key, t.side != 0u ? t.c : t.b);
}

#endif
