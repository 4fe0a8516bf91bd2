// SPDX-License-Identifier: BSD-3-Clause
// Computes the exclusive prefix sum over `count` words in two levels, by groups that share their sums. It is for
// devices whose invocations run in parallel. Software GL, on which barriers are slow, uses parallel/scan.comp; both
// give the same words.
// Pass 0: each group adds up its chunk of words into totals[chunk].
// Pass 1: a single group scans the totals in place and writes the grand total after the last word.
// Pass 2: each group rewrites its chunk as prefix sums.
// Reads and writes words[count + 1]; scratch totals[chunk_count].
// Based on: Hillis & Steele 1986, within a group; Blelloch 1990, between groups.
#version 450 core
layout(local_size_x = 256) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/shared/parameters.glsl"

layout(std430, binding = 0) buffer Words { uint words[]; };
layout(std430, binding = 1) buffer Totals { uint totals[]; };
layout(std140, binding = 0) uniform Parameters { ScanParameters params; };

shared uint sums[gl_WorkGroupSize.x];

// Returns the sum of `own` over the invocations before this one. The last element of sums[] becomes the sum over all
// invocations. The whole group must call it.
uint sum_before(uint own) {
  uint at = gl_LocalInvocationIndex;
  barrier();
  sums[at] = own;
  barrier();
  for (uint step = 1u; step < gl_WorkGroupSize.x; step *= 2u) {
    uint before = at >= step ? sums[at - step] : 0u;
    barrier();
    sums[at] += before;
    barrier();
  }
  return sums[at] - own;
}

void main() {
  uint last = gl_WorkGroupSize.x - 1u;
  uint chunk_count = (params.count + params.chunk_length - 1u) / params.chunk_length;
#if PASS == 1
  uint carry = 0u;
  for (uint first = 0u; first < chunk_count; first += gl_WorkGroupSize.x) {
    uint chunk = first + gl_LocalInvocationIndex;
    uint total = chunk < chunk_count ? totals[chunk] : 0u;
    uint before = sum_before(total);
    if (chunk < chunk_count) totals[chunk] = carry + before;
    carry += sums[last];
  }
  if (gl_LocalInvocationIndex == 0u) words[params.count] = min(carry, params.limit);
#else
  uint chunk = linear_group_index();
  uint each = params.chunk_length / gl_WorkGroupSize.x;
  uint begin = min(chunk * params.chunk_length + gl_LocalInvocationIndex * each, params.count);
  uint end = min(begin + each, params.count);
  uint own = 0u;
  for (uint n = begin; n < end; ++n) own += words[n];
  uint sum = sum_before(own);
#if PASS == 0
  if (chunk < chunk_count && gl_LocalInvocationIndex == last) totals[chunk] = sums[last];
#else
  if (chunk < chunk_count) sum += totals[chunk];
  for (uint n = begin; n < end; ++n) {
    uint word = words[n];
    words[n] = min(sum, params.limit);
    sum += word;
  }
#endif
#endif
}
