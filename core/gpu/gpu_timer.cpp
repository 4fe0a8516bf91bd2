// SPDX-License-Identifier: BSD-3-Clause
// GL timer queries and debug groups around stages.
#include "core/gpu/gpu_timer.h"

#include <algorithm>

#include <epoxy/gl.h>

namespace meniscus {

GpuTimer::~GpuTimer() { glDeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data()); }

GpuTimer::Stage::Stage(const std::string& name) {
  glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(name.size()), name.data());
}

GpuTimer::Stage::~Stage() {
  glEndQuery(GL_TIME_ELAPSED);
  glPopDebugGroup();
}

GpuTimer::Stage GpuTimer::stage(const std::string& name) {
  std::uint32_t query = 0;
  glCreateQueries(GL_TIME_ELAPSED, 1, &query);
  names_.push_back(name);
  queries_.push_back(query);
  glBeginQuery(GL_TIME_ELAPSED, query);
  return Stage(name);
}

std::vector<StageTime> GpuTimer::times() const {
  std::vector<StageTime> result;
  for (std::size_t i = 0; i < queries_.size(); ++i) {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(queries_[i], GL_QUERY_RESULT, &nanoseconds);
    auto stage = std::ranges::find(result, names_[i], &StageTime::name);
    if (stage == result.end()) stage = result.insert(result.end(), {names_[i], 0.0});
    stage->milliseconds += static_cast<double>(nanoseconds) * 1e-6;
  }
  return result;
}

}  // namespace meniscus
