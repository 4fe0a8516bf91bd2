// SPDX-License-Identifier: BSD-3-Clause
// Slices of depth: primitives of a tile stand by them instead of being sorted.
#ifndef MENISCUS_RAY_CAST_DEPTH_SLICES_GLSL
#define MENISCUS_RAY_CAST_DEPTH_SLICES_GLSL

const uint kSliceCount = 32u;
const uint kSlotsPerTile = 2u * kSliceCount;  // spheres first, then tori

uniform float first_depth;          // of slice 0, which also takes what begins before it, in Å
uniform float slices_per_angstrom;  // 0: everything is in slice 0

uint slice_of(float nearest) {
  return uint(clamp((nearest - first_depth) * slices_per_angstrom, 0.0, float(kSliceCount) - 1.0));
}

// No primitive of this slice or a later one has a smaller `nearest`.
float slice_begin(uint slice) {
  // A thousandth of a slice covers the rounding of slice_of.
  return slice == 0u ? -3.0e38 : first_depth + (float(slice) - 1e-3) / slices_per_angstrom;
}

#endif
