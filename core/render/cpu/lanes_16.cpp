// SPDX-License-Identifier: BSD-3-Clause
// Compiles packets of sixteen rays, for processors with AVX-512. Headers with inline code are included first, so that
// their code still runs on every processor.
#include "core/render/cpu/lane_kernels.h"

#if defined(__x86_64__)

#if defined(__clang__) && __clang_major__ >= 18 && __clang_major__ < 22
// These compilers have a separate option for registers of 512 bits (evex512).
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq,avx512vl,avx512bw,evex512"))), apply_to = function)
#elif defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq,avx512vl,avx512bw"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,avx512bw")
#endif
#define MENISCUS_LANES 16
#define MENISCUS_LANE_NAMESPACE lanes_16
#include "core/render/cpu/look_rows.h"
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

const meniscus::LaneKernels* meniscus::kernels_of_16_lanes() {
  return processor_has_avx512() ? &lanes_16::kKernels : nullptr;
}

#else

const meniscus::LaneKernels* meniscus::kernels_of_16_lanes() { return nullptr; }

#endif
