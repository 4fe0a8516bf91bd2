// SPDX-License-Identifier: BSD-3-Clause
// Detects that the driver has cut loops short: Mesa's llvmpipe silently ends every loop of an invocation after 65,535
// iterations in total.
#ifndef MENISCUS_SHARED_LOOP_GUARD_GLSL
#define MENISCUS_SHARED_LOOP_GUARD_GLSL

// True if no loop runs any more. It must be called after the loops in question.
bool loops_cut_short() {
  // The number of iterations is two, but compilers cannot know it, so they do not unroll the loop.
  uint wanted = gl_NumWorkGroups.x == 0u ? 3u : 2u;
  uint steps = 0u;
  for (uint n = 0u; n < wanted; ++n) ++steps;
  return steps != wanted;
}

#endif
