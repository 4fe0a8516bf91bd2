// SPDX-License-Identifier: BSD-3-Clause
// Compiles packets of four rays, for every processor.
#include "core/render/cpu/lane_kernels.h"

#define MENISCUS_LANES 4
#define MENISCUS_LANE_NAMESPACE lanes_4
#include "core/render/cpu/layer_caster.h"
#include "core/render/cpu/look_rows.h"

namespace meniscus {

const LaneKernels* kernels_of_4_lanes() {
  static constexpr LaneKernels kernels{4,
                                       lanes_4::cast_tile,
                                       lanes_4::cast_layer,
                                       lanes_4::light_points,
                                       lanes_4::see_sky,
                                       lanes_4::measure_row,
                                       lanes_4::occlude_rows,
                                       lanes_4::finish_row};
  return &kernels;
}

}  // namespace meniscus
