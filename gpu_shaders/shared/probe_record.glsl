// SPDX-License-Identifier: BSD-3-Clause
// A fixed probe that a view needs, as kernels pass it on, for GLSL and C++ (core/gpu/kernel_records.h).
#ifndef MENISCUS_SHARED_PROBE_RECORD_GLSL
#define MENISCUS_SHARED_PROBE_RECORD_GLSL

struct ProbeRecord {
  dvec3 position;  // Å
  double height;   // over the plane of its atoms, Å
  uvec4 atoms;     // a < b < c, side: as in Triple
  uint key;        // names the triple
  uint unused[3];  // fill the record up to a multiple of 32 bytes
};

#endif
