// SPDX-License-Identifier: BSD-3-Clause
// Cuts and cusp arcs by compute shaders.
#pragma once

#include <memory>

#include "core/gpu/program.h"
#include "core/surface/cusp_tracer.h"

namespace meniscus {

/// Circles in doubt are decided on the host. The context of `programs` must be current; they live longer.
std::unique_ptr<CuspTracer> make_gpu_cusp_tracer(ProgramCache& programs);

}  // namespace meniscus
