// SPDX-License-Identifier: BSD-3-Clause
// Finds the spindle circles that two fixed probes share. All probes of such a circle, a pencil, pass through its two
// axis cusps, so their order about the axis decides there, not arithmetic (docs/explanation/theory.md, Orientation).
//
// This file is written in the common subset of GLSL and C++: variables and functions are those of a kernel, or members
// of a C++ struct that has this file as its body (core/surface/cusp_tracer.cpp). The sides of probe s have the numbers
// from first_side(s) to before first_side(s + 1). The includer defines kNone and
//   uint first_side(uint probe), uint circle_of(uint side), uint partner_of(uint side)   the members of CuspSide
//   pencil_sides                  a list of uint
//   bool reserve_pencils(uint count) makes room for `count` entries; false if there is no room

uint pencil_count;
bool pencils_left_out;  // true if there was no room

// Lists the sides of the lower probe s through which it shares spindle circles with t. Returns false if they are on a
// circle without being neighbours there. Other probes of the circle are then nearer everywhere on their bisector.
GEOMETRY bool find_pencils(uint s, uint t) {
  pencil_count = 0u;
  pencils_left_out = false;
  for (uint n = first_side(s); n < first_side(s + 1u); ++n) {
    if (circle_of(n) == kNone) continue;
    for (uint m = first_side(t); m < first_side(t + 1u); ++m) {
      if (circle_of(m) != circle_of(n)) continue;
      if (partner_of(n) != t) return false;
      if (reserve_pencils(pencil_count + 1u)) pencil_sides[pencil_count++] = n;
      else pencils_left_out = true;
    }
  }
  return true;
}

// True if probe u is on one of the listed circles, too.
GEOMETRY bool on_pencil(uint u) {
  for (uint k = 0u; k < pencil_count; ++k)
    for (uint n = first_side(u); n < first_side(u + 1u); ++n)
      if (circle_of(n) == circle_of(pencil_sides[k])) return true;
  return false;
}
