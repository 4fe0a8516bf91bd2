// SPDX-License-Identifier: BSD-3-Clause
// Parameters that the host passes to the kernels of this stage, as uniform blocks of GLSL and structs of C++
// (core/gpu/kernel_records.h says how).
#ifndef MENISCUS_PARALLEL_PARAMETERS_GLSL
#define MENISCUS_PARALLEL_PARAMETERS_GLSL

struct ScanParameters {
  uint count;         // number of words
  uint chunk_length;  // words per invocation or per group
  uint limit;         // greatest value of a sum
};

#endif
