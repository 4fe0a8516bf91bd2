// SPDX-License-Identifier: BSD-3-Clause
// Compiles packets of four rays, for every processor.
#include "core/render/cpu/lane_kernels.h"

#define MENISCUS_LANES 4
#define MENISCUS_LANE_NAMESPACE lanes_4
#include "core/render/cpu/look_rows.h"

const meniscus::LaneKernels* meniscus::kernels_of_4_lanes() { return &lanes_4::kKernels; }
