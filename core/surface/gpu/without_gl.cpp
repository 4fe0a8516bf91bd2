// SPDX-License-Identifier: BSD-3-Clause
// Refuses the engine of compute shaders, in builds without epoxy.
#include "core/gpu/egl_context.h"
#include "core/surface/gpu/gpu_engine.h"

namespace meniscus {

std::unique_ptr<ReducedSurfaceEngine> make_gpu_engine(const EglContext&) { return nullptr; }  // there is no context

std::unique_ptr<ReducedSurfaceEngine> make_gpu_engine(const DeviceChoice& choice) {
  return make_gpu_engine(EglContext(choice));  // which throws
}

}  // namespace meniscus
