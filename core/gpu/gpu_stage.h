// SPDX-License-Identifier: BSD-3-Clause
// A stage of GPU work under a StageClock, with its name in a GL debugger.
#pragma once

#include <optional>
#include <string>

#include "core/base/stage_clock.h"

namespace meniscus {

/// Lasts as long as the stage. If the clock asks for exact times the GPU is idle at both ends, so that the host's clock
/// is right: GL's own timer queries stay at zero for compute work on llvmpipe (Mesa 22.3). Needs a current context.
class GpuStage {
 public:
  GpuStage(StageClock& clock, const std::string& name);
  ~GpuStage();
  GpuStage(const GpuStage&) = delete;
  GpuStage& operator=(const GpuStage&) = delete;

 private:
  bool waits_;
  std::optional<StageClock::Stage> stage_;
};

}  // namespace meniscus
