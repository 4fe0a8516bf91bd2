// SPDX-License-Identifier: BSD-3-Clause
// Chooses the device and runs the stages one by one under a clock.
#include "app/compute.h"

#include <chrono>
#include <optional>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include "core/base/error.h"
#include "core/reference/exhaustive.h"
#include "core/surface/surface.h"

namespace meniscus {
namespace {

/// Runs `stage` and notes its wall time.
template <class Stage>
auto timed(std::vector<StageTime>& stages, const char* name, Stage stage) {
  const auto start = std::chrono::steady_clock::now();
  auto result = stage();
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
  stages.push_back({name, elapsed.count()});
  return result;
}

ComputedSurface compute_on_cpu(std::span<const Ball> balls, const ComputeOptions& options) {
  ComputedSurface result;
  const ReducedSurface reduced =
      timed(result.stages, "reduced surface", [&] { return enumerate_reduced_surface(balls, options.probe_radius); });
  result.surface =
      timed(result.stages, "primitives", [&] { return assemble_surface(balls, options.probe_radius, reduced); });
  require_closed(result.surface);
  const auto threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  result.device = fmt::format("cpu ({} {})", threads, threads == 1 ? "thread" : "threads");
  return result;
}

}  // namespace

ComputedSurface compute_surface(std::span<const Ball> balls, const ComputeOptions& options) {
  std::optional<tbb::global_control> limit;
  if (options.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
  }
  if (!options.cpu && options.gl.kind != DeviceChoice::Kind::automatic) {
    throw GpuError(
        fmt::format("--device {}: surfaces are not computed through GL yet; use --device cpu", to_string(options.gl)));
  }
  return compute_on_cpu(balls, options);
}

double total_ms(const std::vector<StageTime>& stages) {
  double sum = 0.0;
  for (const StageTime& stage : stages) sum += stage.ms;
  return sum;
}

}  // namespace meniscus
