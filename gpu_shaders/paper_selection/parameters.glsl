// SPDX-License-Identifier: BSD-3-Clause
// Parameters that the host passes to the kernels of this stage, as uniform blocks of GLSL and structs of C++
// (core/gpu/kernel_records.h says how).
#ifndef MENISCUS_PAPER_SELECTION_PARAMETERS_GLSL
#define MENISCUS_PAPER_SELECTION_PARAMETERS_GLSL

struct DrawParameters {
  uint count;  // of atoms or faces
  float probe_radius;
  uint pass;  // one program for both, so that both find the same numbers
};

struct FaceTableParameters {
  uint table_size;  // a power of two, at least twice the number of faces
  uint count;       // of what looks into it or fills it
};

struct FaceParameters {
  uint probe_count;
};

#endif
