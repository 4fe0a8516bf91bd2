// SPDX-License-Identifier: BSD-3-Clause
// Tells whether the driver has cut loops short: Mesa's llvmpipe ends every loop of an invocation, without a word, once
// they have made 65,535 steps together.
#ifndef MENISCUS_SHARED_LOOP_GUARD_GLSL
#define MENISCUS_SHARED_LOOP_GUARD_GLSL

// True if no loop runs any more. To be asked after the loops that matter.
bool loops_cut_short() {
  // Two steps, in a way that no compiler knows, or it would unroll them.
  uint wanted = gl_NumWorkGroups.x == 0u ? 3u : 2u;
  uint steps = 0u;
  for (uint n = 0u; n < wanted; ++n) ++steps;
  return steps != wanted;
}

#endif
