// SPDX-License-Identifier: BSD-3-Clause
// Slices of depth, by which the primitives of a tile are grouped instead of being sorted.
#ifndef MENISCUS_RAY_CAST_DEPTH_SLICES_GLSL
#define MENISCUS_RAY_CAST_DEPTH_SLICES_GLSL
#include "gpu_shaders/ray_cast/parameters.glsl"

const uint kSliceCount = 32u;
const uint kSlotsPerTile = 2u * kSliceCount;  // the slices of spheres first, then the slices of tori


uint slice_of(DepthSlices slices, float nearest) {
  return uint(clamp((nearest - slices.first_depth) * slices.slices_per_angstrom, 0.0, float(kSliceCount) - 1.0));
}

// Returns a lower bound on `nearest` of all primitives in this slice and in later ones.
float slice_begin(DepthSlices slices, uint slice) {
  // A thousandth of a slice covers the rounding of slice_of.
  return slice == 0u ? -3.0e38 : slices.first_depth + (float(slice) - 1e-3) / slices.slices_per_angstrom;
}

#endif
