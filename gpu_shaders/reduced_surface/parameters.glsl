// SPDX-License-Identifier: BSD-3-Clause
// Parameters that the host passes to the kernels of this stage, as uniform blocks of GLSL and structs of C++
// (core/gpu/kernel_records.h says how).
#ifndef MENISCUS_REDUCED_SURFACE_PARAMETERS_GLSL
#define MENISCUS_REDUCED_SURFACE_PARAMETERS_GLSL

// The uniform grid over atom centres, for all kernels that search for neighbours.
struct CellGrid {
  vec4 low;   // xyz: low corner, Å; w: 1 / cell edge
  vec4 size;  // xyz: number of cells along each axis (whole numbers)
};
const int kCellGridBinding = 1;

struct GridParameters {
  uint atom_count;  // upper bound; the GPU has the exact number
};

struct NeighborParameters {
  uint first_entry;  // first entry of the batch
  uint entry_count;  // upper bound on the number of entries in the batch
  float largest_radius;
  uint capacity;  // capacity of the lists
};

struct PairParameters {
  uint first_entry;  // first entry of the batch
  uint entry_count;  // number of entries in the batch
};

struct CircleParameters {
  double doubt;       // decisions by a smaller relative margin go to the host (decision_doubt())
  uint first_entry;   // first entry of the batch, at which the neighbour lists begin
  uint entry_count;   // number of entries in the batch
  uint circle_count;  // upper bound; the GPU has the exact number
  uint list_limit;    // neighbour lists of this total length had no room
  uint arc_capacity;
  uint doubtful_capacity;
};

struct FixedProbeParameters {
  dvec3 middle;  // middle of the atoms
  double probe_radius;
  uint arc_count;  // upper bound; the GPU has the exact number
  uint probe_capacity;
};

#endif
