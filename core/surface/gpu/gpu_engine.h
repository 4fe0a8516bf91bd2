// SPDX-License-Identifier: BSD-3-Clause
// Computes reduced surfaces and their singularities on the GPU.
#pragma once

#include <memory>

#include "core/gpu/device_choice.h"
#include "core/gpu/program.h"
#include "core/surface/cusp_tracer.h"
#include "core/surface/reduced_surface_engine.h"

namespace meniscus {

class EglContext;

/// Makes an engine in this context, which must be current and must outlive the engine. Kernels and buffers are reused
/// from frame to frame. Results equal those of the CPU, arc by arc. Based on Krone, Dachsbacher & Ertl 2010, with
/// circles (contour build-up) in place of their atom triples.
std::unique_ptr<ReducedSurfaceEngine> make_gpu_engine(const EglContext& context);

/// Makes an engine in a context of its own, which it leaves current. Throws GpuError if there is no such device.
std::unique_ptr<ReducedSurfaceEngine> make_gpu_engine(const DeviceChoice& choice);

/// Makes a tracer that leaves circles in doubt to the host. The context of `programs` must be current; `programs` must
/// outlive the tracer.
std::unique_ptr<CuspTracer> make_gpu_cusp_tracer(ProgramCache& programs);

}  // namespace meniscus
