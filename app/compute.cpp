// SPDX-License-Identifier: BSD-3-Clause
// Chooses the device and runs the stages one by one under a clock.
#include "app/compute.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "core/base/error.h"
#include "core/gpu/egl_context.h"
#include "core/reference/exhaustive.h"
#include "core/surface/compare.h"
#include "core/surface/pipeline.h"
#include "core/surface/reduced_surface.h"
#include "core/surface/surface.h"

namespace meniscus {
namespace {

ComputedSurface compute_on_cpu(std::span<const Ball> balls, double probe_radius) {
  StageClock clock;
  ReducedSurface reduced;
  {
    const auto stage = clock.stage("reduced surface");
    reduced = enumerate_reduced_surface(balls, probe_radius);
  }
  ComputedSurface result;
  result.surface = assemble_surface(balls, probe_radius, reduced, &clock);
  result.stages = clock.times();
  const auto threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  result.device = fmt::format("cpu ({} {})", threads, threads == 1 ? "thread" : "threads");
  return result;
}

ComputedSurface compute_on_gl(std::span<const Ball> balls, double probe_radius, const DeviceChoice& choice) {
  const EglContext context(choice);
  SurfacePipeline pipeline;
  ComputedSurface result;
  result.surface = pipeline.run(balls, probe_radius);
  result.stages = pipeline.stage_times();
  result.device = context.renderer() + ", GL " + context.version();
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

// Names every difference: all of them, for a bug report is useless with the first few.
void require_equal(const ComputedSurface& a, const ComputedSurface& b) {
  const std::vector<std::string> found = differences(a.surface, b.surface);
  if (found.empty()) return;
  throw OpenSurfaceError(fmt::format("--verify: {} differences between {} and {}: {}", found.size(), a.device, b.device,
                                     fmt::join(found, "; ")));
}

}  // namespace

ComputedSurface compute_surface(std::span<const Ball> balls, const ComputeOptions& options) {
  std::optional<tbb::global_control> limit;
  if (options.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
  }
  const bool on_cpu = options.cpu || (options.gl.kind == DeviceChoice::Kind::automatic && !has_hardware_gpu());
  ComputedSurface result =
      on_cpu ? compute_on_cpu(balls, options.probe_radius) : compute_on_gl(balls, options.probe_radius, options.gl);
  require_closed(result.surface);
  if (options.verify) {
    const ComputedSurface other =
        on_cpu ? compute_on_gl(balls, options.probe_radius, {}) : compute_on_cpu(balls, options.probe_radius);
    require_equal(result, other);
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
