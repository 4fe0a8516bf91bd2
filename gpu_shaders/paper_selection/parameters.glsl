// SPDX-License-Identifier: BSD-3-Clause
// Parameters that the host passes to the kernels of this stage, as uniform blocks of GLSL and structs of C++
// (core/gpu/kernel_records.h says how).
#ifndef MENISCUS_PAPER_SELECTION_PARAMETERS_GLSL
#define MENISCUS_PAPER_SELECTION_PARAMETERS_GLSL

struct DrawParameters {
  uint count;  // number of atoms or faces
  float probe_radius;
  uint pass;  // 0 or 1; one program does both passes, so that both compute the same numbers
};

struct FaceTableParameters {
  uint table_size;  // a power of two, at least twice the number of faces
  uint count;       // number of faces that fill it, or of arcs that search it
};

struct FaceParameters {
  uint probe_count;
};

#endif
