// SPDX-License-Identifier: BSD-3-Clause
// The surface on the GPU: its reduced surface and its singularities.
#pragma once

#include <memory>

#include "core/gpu/device_choice.h"
#include "core/gpu/program.h"
#include "core/surface/cusp_tracer.h"
#include "core/surface/reduced_surface_engine.h"

namespace meniscus {

class EglContext;

/// In this context, which is current and lives longer. Kernels and buffers stay from frame to frame. Results equal
/// those of the CPU, arc by arc. Based on Krone, Dachsbacher & Ertl 2010, with circles (contour build-up) in place of
/// their atom triples.
std::unique_ptr<ReducedSurfaceEngine> make_gpu_engine(const EglContext& context);

/// The same in a context of its own, which it leaves current. Throws GpuError if there is no such device.
std::unique_ptr<ReducedSurfaceEngine> make_gpu_engine(const DeviceChoice& choice);

/// Circles in doubt are decided on the host. The context of `programs` must be current; they live longer.
std::unique_ptr<CuspTracer> make_gpu_cusp_tracer(ProgramCache& programs);

}  // namespace meniscus
