// SPDX-License-Identifier: BSD-3-Clause
// Test kernel: writes index * FACTOR + offset to every word below the count, and counts the words past it.
#version 450 core
#ifndef FACTOR
#define FACTOR 1
#endif
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/linear_index.glsl"

layout(std430, binding = 0) buffer Words { uint words[]; };
layout(std430, binding = 1) buffer Counters { uint surplus; };
uniform uint count;
uniform uint offset;

void main() {
  uint i = linear_invocation_index();
  if (i < count) words[i] = i * uint(FACTOR) + offset;
  else atomicAdd(surplus, 1u);
}
