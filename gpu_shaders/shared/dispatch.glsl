// SPDX-License-Identifier: BSD-3-Clause
// The place of an invocation in a dispatch, which the host may have folded into a rectangle, and loops that a driver
// cuts short. This file must follow the kernel's layout(local_size_x = ...), which defines gl_WorkGroupSize.

uint linear_group_index() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

uint linear_invocation_index() { return linear_group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

// True if no loop runs any more. It must be called after the loops in question: Mesa's llvmpipe silently ends every
// loop of an invocation after 65,535 iterations in total.
bool loops_cut_short() {
  // The number of iterations is two, but compilers cannot know it, so they do not unroll the loop.
  uint wanted = gl_NumWorkGroups.x == 0u ? 3u : 2u;
  uint steps = 0u;
  for (uint n = 0u; n < wanted; ++n) ++steps;
  return steps != wanted;
}
