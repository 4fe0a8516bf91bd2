// SPDX-License-Identifier: BSD-3-Clause
// Wall times and debug groups around GPU stages.
#include "core/gpu/gpu_stage.h"

#include <epoxy/gl.h>

namespace meniscus {

GpuStage::GpuStage(StageClock& clock, const std::string& name) : waits_(clock.is_exact()) {
  glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(name.size()), name.data());
  if (waits_) glFinish();
  stage_.emplace(clock, name);
}

GpuStage::~GpuStage() {
  if (waits_) glFinish();
  stage_.reset();
  glPopDebugGroup();
}

}  // namespace meniscus
