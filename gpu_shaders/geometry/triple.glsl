// SPDX-License-Identifier: BSD-3-Clause
// Names the points where three balls meet, for fixed probes (balls = SAS balls of atoms) and for cusp curves (balls = fixed
// probes): in one order that all three arcs that end there agree on.
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

#endif
