// SPDX-License-Identifier: BSD-3-Clause
// Chooses the device and runs the stages one by one under a clock.
#include "app/compute.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "core/base/error.h"
#include "core/gpu/egl_context.h"
#include "core/reference/exhaustive.h"
#include "core/surface/pipeline.h"
#include "core/surface/reduced_surface.h"
#include "core/surface/surface.h"

namespace meniscus {
namespace {

// A reduced surface and how it came to be.
struct Reduction {
  ReducedSurface reduced;
  std::string device;
};

Reduction reduce_on_cpu(std::span<const Ball> balls, double probe_radius, StageClock& clock) {
  const auto stage = clock.stage("reduced surface");
  const auto threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return {enumerate_reduced_surface(balls, probe_radius),
          fmt::format("cpu ({} {})", threads, threads == 1 ? "thread" : "threads")};
}

Reduction reduce_on_gl(std::span<const Ball> balls, double probe_radius, const DeviceChoice& choice,
                       StageClock& clock) {
  const EglContext context(choice);
  SurfacePipeline pipeline;
  Reduction result{pipeline.reduce(balls, probe_radius), context.renderer() + ", GL " + context.version()};
  for (const StageTime& time : pipeline.stage_times()) clock.add(time.name, time.milliseconds);
  return result;
}

bool has_hardware_gpu() {
  try {
    const auto devices = list_gl_devices();
    return std::any_of(devices.begin(), devices.end(), [](const GlDevice& d) { return !d.software; });
  } catch (const GpuError&) {
    return false;  // no EGL at all
  }
}

// Compares two reduced surfaces arc by arc; the message names the first differences.
void require_equal(const Reduction& a, const Reduction& b) {
  if (a.reduced == b.reduced) return;
  std::vector<RsArc> only_a, only_b;
  std::set_difference(a.reduced.arcs.begin(), a.reduced.arcs.end(), b.reduced.arcs.begin(), b.reduced.arcs.end(),
                      std::back_inserter(only_a));
  std::set_difference(b.reduced.arcs.begin(), b.reduced.arcs.end(), a.reduced.arcs.begin(), a.reduced.arcs.end(),
                      std::back_inserter(only_b));
  std::string text = fmt::format("--verify: {} arcs only on {}, {} only on {}, lone atoms {} and {}:", only_a.size(),
                                 a.device, only_b.size(), b.device, a.reduced.lone_atoms.size(),
                                 b.reduced.lone_atoms.size());
  for (const auto* only : {&only_a, &only_b})
    for (const RsArc& arc : *only)
      text += fmt::format(" ({} {} from {} to {})", arc.i + 1, arc.j + 1, static_cast<int>(arc.begin_by) + 1,
                          static_cast<int>(arc.end_by) + 1);
  throw OpenSurfaceError(text);
}

}  // namespace

ComputedSurface compute_surface(std::span<const Ball> balls, const ComputeOptions& options) {
  std::optional<tbb::global_control> limit;
  if (options.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
  }
  StageClock clock;
  const bool on_cpu =
      options.cpu || (options.gl.kind == DeviceChoice::Kind::automatic && !has_hardware_gpu());
  Reduction reduction = on_cpu ? reduce_on_cpu(balls, options.probe_radius, clock)
                               : reduce_on_gl(balls, options.probe_radius, options.gl, clock);
  ComputedSurface result;
  result.surface = assemble_surface(balls, options.probe_radius, reduction.reduced, &clock);
  require_closed(result.surface);
  result.stages = clock.times();
  result.device = reduction.device;
  if (options.verify) {
    StageClock unused;
    const Reduction other = on_cpu ? reduce_on_gl(balls, options.probe_radius, {}, unused)
                                   : reduce_on_cpu(balls, options.probe_radius, unused);
    require_equal(reduction, other);
    result.device += fmt::format(", verified on {}", other.device);
  }
  return result;
}

double total_ms(const std::vector<StageTime>& stages) {
  double sum = 0.0;
  for (const StageTime& stage : stages) sum += stage.milliseconds;
  return sum;
}

}  // namespace meniscus
