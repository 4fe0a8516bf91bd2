// SPDX-License-Identifier: BSD-3-Clause
// Parameters that the host passes to the kernels of this stage, as uniform blocks of GLSL and structs of C++
// (core/gpu/kernel_records.h says how).
#ifndef MENISCUS_SINGULARITIES_PARAMETERS_GLSL
#define MENISCUS_SINGULARITIES_PARAMETERS_GLSL

struct CutParameters {
  uint first_probe;  // first probe of the batch
  uint probe_count;  // number of probes in the batch
  float probe_radius;
};

struct CuspParameters {
  uint first_probe;  // first probe of the batch, at which the neighbour lists begin
  uint circle_count;
  uint arc_capacity;
  uint doubtful_capacity;
};

#endif
