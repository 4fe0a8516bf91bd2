// SPDX-License-Identifier: BSD-3-Clause
// Parameters that the host passes to the kernels of this stage, as uniform blocks of GLSL and structs of C++
// (core/gpu/kernel_records.h says how).
#ifndef MENISCUS_PRIMITIVES_PARAMETERS_GLSL
#define MENISCUS_PRIMITIVES_PARAMETERS_GLSL

// How primitives are seen and where they go, for all kernels that make them.
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
  uint arc_count;  // at most; the GPU knows how many
};

struct ConcaveParameters {
  uint first_probe;  // of the batch
  uint probe_count;  // in the batch, at most
};

struct ConvexParameters {
  dvec3 middle;      // of the atoms
  uint first_entry;  // of the batch
  uint entry_count;  // in the batch, at most
  uint atom_count;
};

#endif
