// SPDX-License-Identifier: BSD-3-Clause
// The end of every kernel: counts the groups that reach it, for core/gpu/work_proof.h to compare with those started.
// Appended to each kernel, whose own main() is called kernel_main() there, so that no early return slips past.
#undef main
layout(binding = 0, offset = 0) uniform atomic_uint finished_groups;

void main() {
  kernel_main();
  // One invocation stands for its group: the last, as software GL runs them in order.
  if (gl_LocalInvocationIndex == gl_WorkGroupSize.x * gl_WorkGroupSize.y * gl_WorkGroupSize.z - 1u)
    atomicCounterIncrement(finished_groups);
}
