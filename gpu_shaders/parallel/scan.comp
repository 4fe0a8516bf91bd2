// SPDX-License-Identifier: BSD-3-Clause
// Computes the exclusive prefix sum over `count` words in three passes of serial chunks. It uses no barriers, because
// they are slow on software GL.
// Pass 0: one invocation per chunk adds up its words into totals[chunk].
// Pass 1: a single invocation scans the totals in place and writes the grand total after the last word.
// Pass 2: one invocation per chunk rewrites its words as prefix sums.
// Reads and writes words[count + 1]; scratch totals[chunk_count].
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/shared/parameters.glsl"

layout(std430, binding = 0) buffer Words { uint words[]; };
layout(std430, binding = 1) buffer Totals { uint totals[]; };
layout(std140, binding = 0) uniform Parameters { ScanParameters params; };

void main() {
  uint chunk = linear_invocation_index();
#if PASS == 1
  if (chunk != 0u) return;
  uint sum = 0u;
  uint chunk_count = (params.count + params.chunk_length - 1u) / params.chunk_length;
  for (uint n = 0u; n < chunk_count; ++n) {
    uint total = totals[n];
    totals[n] = sum;
    sum += total;
  }
  words[params.count] = min(sum, params.limit);
#else
  uint begin = chunk * params.chunk_length;
  if (begin >= params.count) return;
  uint end = min(begin + params.chunk_length, params.count);
#if PASS == 0
  uint sum = 0u;
  for (uint n = begin; n < end; ++n) sum += words[n];
  totals[chunk] = sum;
#else
  uint sum = totals[chunk];
  for (uint n = begin; n < end; ++n) {
    uint word = words[n];
    words[n] = min(sum, params.limit);
    sum += word;
  }
#endif
#endif
}
