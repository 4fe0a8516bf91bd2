// SPDX-License-Identifier: BSD-3-Clause
// A fixed probe that a view needs, as kernels hand it on (64 bytes, std430).
struct ProbeRecord {
  dvec3 position;  // Å
  double height;   // over the plane of its atoms, Å
  uvec4 atoms;     // a < b < c; side 1: the probe stands on the side of cross(b - a, c - a)
  uint key;        // names the triple
  uint unused[3];  // fill the record up to a multiple of 32 bytes
};
