// SPDX-License-Identifier: BSD-3-Clause
// Parameters that the host passes to the kernels of this stage, as uniform blocks of GLSL and structs of C++
// (core/gpu/kernel_records.h says how).
#ifndef MENISCUS_VISIBILITY_PARAMETERS_GLSL
#define MENISCUS_VISIBILITY_PARAMETERS_GLSL

struct View {
  vec3 eye;           // relative to the middle of the atoms
  float pixel_scale;  // size of a pixel at distance 1; orthographic: in Å
  vec3 right;
  float margin;  // covers the rounding of every bound, in Å
  vec3 up;
  uint orthographic;
  vec3 forward;
  int block_edge;      // pixels; divides kTileEdge
  ivec2 picture_size;  // pixels
  uint keep_all;       // 1 if the eye may be in the solid, or if the whole surface is requested
};
const int kViewBinding = 2;

struct VisibleAtomsParameters {
  uint atom_count;
  float probe_radius;
};

#endif
