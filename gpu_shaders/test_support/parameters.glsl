// SPDX-License-Identifier: BSD-3-Clause
// Parameters of test kernels, as uniform blocks of GLSL and structs of C++ (core/gpu/kernel_records.h says how).
#ifndef MENISCUS_TEST_SUPPORT_PARAMETERS_GLSL
#define MENISCUS_TEST_SUPPORT_PARAMETERS_GLSL

struct ScaleParameters {
  uint count;
  uint offset;
};

struct LoopParameters {
  uint outer;
  uint inner;
};

struct QueryParameters {
  uint count;
};

#endif
