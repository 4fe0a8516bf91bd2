// SPDX-License-Identifier: BSD-3-Clause
// Computes the index of a group or an invocation in a dispatch that the host may have folded into a rectangle.
// To be included after the kernel's layout(local_size_x = ...), which defines gl_WorkGroupSize.

uint linear_group_index() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

uint linear_invocation_index() { return linear_group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }
