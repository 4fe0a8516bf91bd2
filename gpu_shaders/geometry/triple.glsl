// SPDX-License-Identifier: BSD-3-Clause
// Names the points where three balls meet, in one order that all three arcs that end there agree on: for fixed probes (balls =
// SAS balls of atoms) and for cusp curves (balls = fixed probes); and patches, for rays that meet two of them at one distance.
//
// Common subset of GLSL and C++; in C++ the includer provides uint.
#ifndef MENISCUS_GEOMETRY_TRIPLE_GLSL
#define MENISCUS_GEOMETRY_TRIPLE_GLSL

// Three balls, ascending; side 1: the point is on the side of cross(b - a, c - a).
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

// Where the covered part of the circle (i, j), i < j, ends by k, the point is on the side of cross(j - i, k - i); where it
// begins, on the other (see covered_arc()). An arc ends where a covered part begins.
GEOMETRY Triple triple_at(uint i, uint j, uint k, bool at_end) {
  uint side = at_end ? 0u : 1u;
  if (k < i) return triple_of(k, i, j, side);
  if (k < j) return triple_of(i, k, j, side ^ 1u);
  return triple_of(i, j, k, side);
}

// The place that the circle (i, j) of a triple leaves to k: 0, the last, 1, the middle, or 2, the first.
GEOMETRY uint role_of_third(uint i, uint j, uint k) { return k > j ? 0u : k > i ? 1u : 2u; }

// Patches are named by what they are rather than by where they are. Keys are made by add_to_key, from 0 on:
//   convex patch: its atom, and nothing is added;
//   concave patch: its contacts, counter-clockwise seen from the probe, the smallest first;
//   toroidal patch: its two atoms, then, unless it is free, the keys of the concave patches at its start and its end.
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
