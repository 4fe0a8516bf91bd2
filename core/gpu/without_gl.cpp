// SPDX-License-Identifier: BSD-3-Clause
// Refuses GL contexts, in builds without epoxy.
#include "core/base/error.h"
#include "core/gpu/egl_context.h"

namespace meniscus {

WorkProof::~WorkProof() = default;
KernelFiles::~KernelFiles() = default;

EglContext::EglContext(const DeviceChoice&) {
  throw GpuError("this build has no GL, for it was made without epoxy; choose the CPU");
}
EglContext::~EglContext() = default;

}  // namespace meniscus
