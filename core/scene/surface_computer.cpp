// SPDX-License-Identifier: BSD-3-Clause
// Chooses the device and runs the stages one by one under a clock.
#include "core/scene/surface_computer.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "core/base/error.h"
#include "core/gpu/egl_context.h"
#include "core/reduced_surface/cpu/exhaustive.h"
#include "core/queries/compare.h"
#include "core/surface/gpu/pipeline.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/surface.h"
#include "core/surface/tie_ladder.h"

namespace meniscus {
namespace {

std::string cpu_device() {
  const auto threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return fmt::format("cpu ({} {})", threads, threads == 1 ? "thread" : "threads");
}

/// Any GL will do, but hardware is better.
DeviceChoice gl_for_verifying(const SurfaceRequest& request) {
  DeviceChoice choice = request.gl;
  choice.kind = DeviceChoice::Kind::automatic;
  return choice;
}

// Names every difference: all of them, for a bug report is useless with the first few.
void require_equal(const Surface& a, const std::string& device_a, const Surface& b, const std::string& device_b) {
  const std::vector<std::string> found = differences(a, b);
  if (found.empty()) return;
  throw OpenSurfaceError(fmt::format("--verify: {} differences between {} and {}: {}", found.size(), device_a, device_b,
                                     fmt::join(found, "; ")));
}

}  // namespace

struct SurfaceComputer::GlPipeline {
  GlPipeline(const EglContext* shared, const DeviceChoice& choice) {
    if (!shared) own.emplace(choice);
    const EglContext& context = shared ? *shared : *own;
    device = context.renderer() + ", GL " + context.version();
  }
  std::optional<EglContext> own;
  std::string device;
  SurfacePipeline pipeline;
};

SurfaceComputer::SurfaceComputer(const SurfaceRequest& request, const EglContext* context)
    : request_(request), context_(context), on_cpu_(request.cpu) {
  if (request.kind == SurfaceKind::vdw && request.probe_named)
    throw RequestError("--probe: the van der Waals surface has no probe; leave --probe or --surface vdw away");
  if (request.threads > 0) {
    thread_limit_.reset(new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                                static_cast<std::size_t>(request.threads)));
  }
  if (!request.cpu && request.gl.kind == DeviceChoice::Kind::automatic) on_cpu_ = !find_hardware();
}

// Automatic never lands on software GL. A list of devices does not tell: only a context knows its renderer.
bool SurfaceComputer::find_hardware() {
  if (context_) return !context_->is_software();
  DeviceChoice hardware = request_.gl;
  hardware.kind = DeviceChoice::Kind::gpu;
  try {
    gl_ = std::make_unique<GlPipeline>(nullptr, hardware);
    return true;
  } catch (const GpuError&) {
    return false;  // no EGL, no GPU, or none with GL 4.5
  }
}

SurfaceComputer::~SurfaceComputer() = default;

Surface SurfaceComputer::compute(std::span<const Ball> balls) {
  std::vector<Ball> grown;
  if (request_.kind == SurfaceKind::sas) {
    grown.assign(balls.begin(), balls.end());
    for (Ball& ball : grown) ball.radius += request_.probe_radius;
    balls = grown;
  }
  const double probe_radius = request_.kind == SurfaceKind::ses ? request_.probe_radius : 0.0;
  Surface surface =
      on_cpu_ ? compute_on_cpu(balls, probe_radius, clock_) : compute_on_gl(balls, probe_radius, request_.gl, clock_);
  if (!request_.verify) {
    device_ = on_cpu_ ? cpu_device() : gl_->device;
    return surface;
  }
  // The other device's time is not this one's.
  StageClock unused;
  const Surface other = on_cpu_ ? compute_on_gl(balls, probe_radius, gl_for_verifying(request_), unused)
                                : compute_on_cpu(balls, probe_radius, unused);
  const std::string first = on_cpu_ ? cpu_device() : gl_->device, second = on_cpu_ ? gl_->device : cpu_device();
  require_equal(surface, first, other, second);
  if (surface.certificate.closed && request_.check) request_.check(surface);
  device_ = fmt::format("{}, verified on {}", first, second);
  return surface;
}

Surface SurfaceComputer::compute_on_cpu(std::span<const Ball> given, double probe_radius, StageClock& clock) {
  return compute_through_ties(given, [&](std::span<const Ball> balls) {
    ReducedSurface reduced;
    {
      const auto stage = clock.stage("reduced surface");
      reduced = enumerate_reduced_surface(balls, probe_radius);
    }
    return assemble_surface(balls, probe_radius, reduced, &clock);
  });
}

Surface SurfaceComputer::compute_on_gl(std::span<const Ball> given, double probe_radius, const DeviceChoice& choice,
                                       StageClock& clock) {
  if (!gl_) gl_ = std::make_unique<GlPipeline>(context_, choice);
  return compute_through_ties(given, [&](std::span<const Ball> balls) {
    Surface surface = gl_->pipeline.run(balls, probe_radius);
    for (const StageTime& stage : gl_->pipeline.stage_times()) clock.add(stage.name, stage.milliseconds);
    return surface;
  });
}

ComputedSurface compute_surface(std::span<const Ball> balls, const SurfaceRequest& request) {
  SurfaceComputer computer(request);
  ComputedSurface result;
  result.surface = computer.compute(balls);
  require_closed(result.surface);
  result.device = computer.device();
  result.stages = computer.stages();
  return result;
}

double total_ms(const std::vector<StageTime>& stages) {
  double sum = 0.0;
  for (const StageTime& stage : stages) sum += stage.milliseconds;
  return sum;
}

}  // namespace meniscus
