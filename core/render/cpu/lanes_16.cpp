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
#include "core/render/cpu/layer_caster.h"
#include "core/render/cpu/look_rows.h"
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

namespace meniscus {

const LaneKernels* kernels_of_16_lanes() {
  static constexpr LaneKernels kernels{16,
                                       lanes_16::cast_tile,
                                       lanes_16::cast_layer,
                                       lanes_16::light_points,
                                       lanes_16::see_sky,
                                       lanes_16::measure_row,
                                       lanes_16::occlude_rows,
                                       lanes_16::finish_row};
  return processor_has_avx512() ? &kernels : nullptr;
}

}  // namespace meniscus

#else

namespace meniscus {

const LaneKernels* kernels_of_16_lanes() { return nullptr; }

}  // namespace meniscus

#endif
