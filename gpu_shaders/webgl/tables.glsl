// SPDX-License-Identifier: BSD-3-Clause
// Definitions that shaders of WebGL 2 (GLSL ES 3.00) need before the sources that they share with the kernels:
// precisions, and tables in textures of 2048 columns where kernels have buffers.
#ifndef MENISCUS_WEBGL_TABLES_GLSL
#define MENISCUS_WEBGL_TABLES_GLSL
precision highp float;
precision highp int;
precision highp usampler2D;
#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/ray_cast/parameters.glsl"
#include "gpu_shaders/ray_cast/records.glsl"

const int kTableShift = 11;  // there are 2^11 columns

uvec4 entry(usampler2D table, uint index) {
  int i = int(index);
  return texelFetch(table, ivec2(i & ((1 << kTableShift) - 1), i >> kTableShift), 0);
}

uniform usampler2D primitive_texels;  // three texels each: struct Primitive
layout(std140) uniform ViewBlock { BlockView view; };
uniform vec3 pivot;  // the picture's pivot, in the coordinates of the records

#endif
