// SPDX-License-Identifier: BSD-3-Clause
// What the host tells the kernels of this stage, as uniform blocks of GLSL and structs of C++
// (core/gpu/kernel_parameters.h says how).
#ifndef MENISCUS_LOOK_PARAMETERS_GLSL
#define MENISCUS_LOOK_PARAMETERS_GLSL

struct DepthParameters {
  uint has_parts;
};

struct OcclusionParameters {
  float radius;         // Å
  float longest_reach;  // pixels
  uint sample_index;    // other samples take other places of the pattern
};

struct FinishParameters {
  float ambient_occlusion;
  float silhouettes;  // pixels
  float depth_cue;
  float first_depth;
  float last_depth;
  uint sample_index;
  uint has_parts;
};

struct PresentParameters {
  vec3 background;   // linear
  float per_sample;  // 1 / number of samples
  ivec2 size;
};

#endif
