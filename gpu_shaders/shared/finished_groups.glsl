// SPDX-License-Identifier: BSD-3-Clause
// Counts the groups that reach the end of a kernel, which core/gpu/work_proof.h compares with the started ones.
// It is appended to each kernel, whose own main() is renamed to kernel_main(), so that early returns are counted, too.
#undef main
layout(binding = 0, offset = 0) uniform atomic_uint finished_groups;

void main() {
  kernel_main();
  // The last invocation counts for its group, because software GL runs invocations in order.
  if (gl_LocalInvocationIndex == gl_WorkGroupSize.x * gl_WorkGroupSize.y * gl_WorkGroupSize.z - 1u)
    atomicCounterIncrement(finished_groups);
}
