// SPDX-License-Identifier: BSD-3-Clause
// Reports that there is no GPU engine, in builds without GL.
#include "core/gpu/egl_context.h"
#include "core/surface/compute_surface.h"

namespace meniscus {

std::unique_ptr<ReducedSurfaceEngine> make_gpu_engine(const EglContext&) { return nullptr; }  // a context never exists

std::unique_ptr<ReducedSurfaceEngine> make_gpu_engine(const DeviceChoice& choice) {
  return make_gpu_engine(EglContext(choice));  // the constructor throws
}

}  // namespace meniscus
