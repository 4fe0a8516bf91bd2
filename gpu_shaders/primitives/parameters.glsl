// SPDX-License-Identifier: BSD-3-Clause
// Parameters that the host passes to the kernels of this stage, as uniform blocks of GLSL and structs of C++
// (core/gpu/kernel_records.h says how).
#ifndef MENISCUS_PRIMITIVES_PARAMETERS_GLSL
#define MENISCUS_PRIMITIVES_PARAMETERS_GLSL

// The camera and the capacities of the tables, for all kernels that make primitives.
struct PrimitiveParameters {
  dvec3 pivot;
  double eye_distance;  // from the camera to the pivot
  dvec3 camera_position;
  double probe_radius;
  dvec3 camera_forward;
  float slack;
  uint orthographic;
  uint primitive_capacity;
  uint row_capacity;
};
const int kPrimitiveBinding = 1;

struct ArcParameters {
  uint arc_count;  // upper bound; the GPU has the exact number
};

struct ConcaveParameters {
  uint first_probe;  // first probe of the batch
  uint probe_count;  // upper bound on the number of probes in the batch
};

struct ConvexParameters {
  dvec3 middle;      // middle of the atoms
  uint first_entry;  // first entry of the batch
  uint entry_count;  // upper bound on the number of entries in the batch
  uint atom_count;
};

#endif
