// SPDX-License-Identifier: BSD-3-Clause
// Parameters that the host passes to the kernels of this stage, as uniform blocks of GLSL and structs of C++
// (core/gpu/kernel_records.h says how).
#ifndef MENISCUS_REDUCED_SURFACE_PARAMETERS_GLSL
#define MENISCUS_REDUCED_SURFACE_PARAMETERS_GLSL

// The uniform grid over atom centres, as all kernels that look for neighbours see it.
struct CellGrid {
  vec4 low;   // xyz: low corner, Å; w: 1 / cell edge
  vec4 size;  // xyz: number of cells along each axis (whole numbers)
};
const int kCellGridBinding = 1;

struct GridParameters {
  uint atom_count;  // at most; the GPU knows how many
};

struct NeighborParameters {
  uint first_entry;  // of the batch
  uint entry_count;  // in the batch, at most
  float largest_radius;
  uint capacity;  // of the lists
};

struct PairParameters {
  uint first_entry;  // of the batch
  uint entry_count;  // in the batch
};

struct CircleParameters {
  double doubt;       // what is decided by less goes to the host: relative, see decision_doubt()
  uint first_entry;   // of the batch, which the neighbour lists count from
  uint entry_count;   // in the batch
  uint circle_count;  // at most; the GPU knows how many
  uint list_limit;    // neighbour lists that have come to it had no room
  uint arc_capacity;
  uint doubtful_capacity;
};

struct FixedProbeParameters {
  dvec3 middle;  // of the atoms
  double probe_radius;
  uint arc_count;  // at most; the GPU knows how many
  uint probe_capacity;
};

#endif
