// SPDX-License-Identifier: BSD-3-Clause
// Reports that there are no GL contexts, in builds without epoxy.
#include "core/base/error.h"
#include "core/gpu/egl_context.h"

namespace meniscus {

WorkProof::~WorkProof() = default;
KernelFiles::~KernelFiles() = default;

EglContext::EglContext(const DeviceChoice&) {
  throw GpuError(
      "this build was made without epoxy and has no GL; choose the CPU, or build Meniscus from source, with epoxy");
}
EglContext::~EglContext() = default;

}  // namespace meniscus
