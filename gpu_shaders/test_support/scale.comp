// SPDX-License-Identifier: BSD-3-Clause
// Test kernel: writes index * FACTOR + offset to every word below the count, and counts the words past it.
#version 450 core
#ifndef FACTOR
#define FACTOR 1
#endif
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/shared/parameters.glsl"

layout(std430, binding = 0) buffer Words { uint words[]; };
layout(std430, binding = 1) buffer Counters { uint surplus; };
layout(std140, binding = 0) uniform Parameters { ScaleParameters params; };

void main() {
  uint i = linear_invocation_index();
  if (i < params.count) words[i] = i * uint(FACTOR) + params.offset;
  else atomicAdd(surplus, 1u);
}
