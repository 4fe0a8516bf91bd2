// SPDX-License-Identifier: BSD-3-Clause
// Test kernel: counts in two nested loops, and reports if they were cut short.
#version 450 core
layout(local_size_x = 1) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/shared/parameters.glsl"

layout(std430, binding = 0) writeonly buffer Found { uint counted; uint cut_short; };
layout(std140, binding = 0) uniform Parameters { LoopParameters params; };

void main() {
  uint count = 0u;
  for (uint n = 0u; n < params.outer; ++n)
    for (uint m = 0u; m < params.inner; ++m) count += 1u + (count & 0u);
  counted = count;
  cut_short = loops_cut_short() ? 1u : 0u;
}
