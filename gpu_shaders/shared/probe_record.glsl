// SPDX-License-Identifier: BSD-3-Clause
// The record of a fixed probe that a view needs, for GLSL and C++ (core/gpu/kernel_records.h).
#ifndef MENISCUS_SHARED_PROBE_RECORD_GLSL
#define MENISCUS_SHARED_PROBE_RECORD_GLSL

struct ProbeRecord {
  dvec3 position;  // Å
  double height;   // height over the plane of its atoms, Å
  uvec4 atoms;     // members of Triple: a < b < c, side
  uint key;        // key of the triple
  uint unused[3];  // fill the record up to a multiple of 32 bytes
};

#endif
