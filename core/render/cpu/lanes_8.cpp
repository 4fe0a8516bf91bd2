// SPDX-License-Identifier: BSD-3-Clause
// Compiles packets of eight rays, for processors with AVX2. Headers with inline code are included first, so that their
// code still runs on every processor.
#include "core/render/cpu/lane_kernels.h"

#if defined(__x86_64__)

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
#define MENISCUS_LANES 8
#define MENISCUS_LANE_NAMESPACE lanes_8
#include "core/render/cpu/look_rows.h"
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

const meniscus::LaneKernels* meniscus::kernels_of_8_lanes() {
  return processor_has_avx2() ? &lanes_8::kKernels : nullptr;
}

#else

const meniscus::LaneKernels* meniscus::kernels_of_8_lanes() { return nullptr; }

#endif
