// SPDX-License-Identifier: BSD-3-Clause
// How long each stage takes on the GPU, and the stage's name in a GL debugger.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/stage_clock.h"

namespace meniscus {

/// Measures stages that follow one another (GL_TIME_ELAPSED cannot nest). Needs a current context.
class GpuTimer {
 public:
  GpuTimer() = default;
  ~GpuTimer();
  GpuTimer(const GpuTimer&) = delete;
  GpuTimer& operator=(const GpuTimer&) = delete;

  /// A stage lasts as long as the returned object.
  class Stage {
   public:
    explicit Stage(const std::string& name);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
  };
  [[nodiscard]] Stage stage(const std::string& name);

  /// Times in order of the stages, stages of one name added up. Waits for the GPU.
  std::vector<StageTime> times() const;

 private:
  std::vector<std::string> names_;
  std::vector<std::uint32_t> queries_;
};

}  // namespace meniscus
