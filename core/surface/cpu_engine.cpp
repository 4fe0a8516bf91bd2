// SPDX-License-Identifier: BSD-3-Clause
// Exhaustive enumeration and tracing of cusps on all cores.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include "core/reduced_surface/cpu/exhaustive.h"
#include "core/surface/reduced_surface_engine.h"
#include "core/base/stage_clock.h"

namespace meniscus {
namespace {

class CpuEngine final : public ReducedSurfaceEngine {
 public:
  ReducedSurface reduce(std::span<const Ball> atoms, double probe_radius, StageClock& clock) override {
    const auto stage = clock.stage("reduced surface");
    stats_ = {};
    return enumerate_reduced_surface(atoms, probe_radius, &stats_);
  }

  CuspTracer& cusp_tracer() override { return *cusp_tracer_; }
  const CircleStats& stats() const override { return stats_; }

  std::string device() const override {
    const auto threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return fmt::format("cpu ({} {})", threads, threads == 1 ? "thread" : "threads");
  }

 private:
  std::unique_ptr<CuspTracer> cusp_tracer_ = make_cpu_cusp_tracer();
  CircleStats stats_;
};

}  // namespace

std::unique_ptr<ReducedSurfaceEngine> make_cpu_engine() { return std::make_unique<CpuEngine>(); }

}  // namespace meniscus
