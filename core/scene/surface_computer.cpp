// SPDX-License-Identifier: BSD-3-Clause
// Computes surfaces on the CPU or the GPU, and checks what was requested of them.
//
// Makes accessible surfaces of excluded ones: the probe's centre moves on balls enlarged by its radius (Lee and
// Richards 1971).
#include "core/scene/surface_computer.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/gpu/egl_context.h"
#include "core/queries/surface_object.h"
#include "core/surface/blocks.h"
#include "core/surface/compute_surface.h"

namespace meniscus {
namespace {

// Below 0.001 Å the patches between atoms are thinner than any file's coordinates are precise; above 100 Å the probe is
// larger than most molecules and every atom neighbours every other.
constexpr double kSmallestProbe = 1e-3;
constexpr double kLargestProbe = 100.0;

}  // namespace

const char* kind_word(SurfaceKind kind) {
  constexpr const char* kWords[] = {"ses", "sas", "vdw"};
  return kWords[static_cast<std::size_t>(kind)];
}

std::string probe_fault(double radius) {
  if (radius != 0.0 && radius < kSmallestProbe)
    return fmt::format("{} Å is {}; use at least {} Å, or the van der Waals surface", radius,
                       radius < 0.0 ? "negative" : "too small", kSmallestProbe);
  if (radius > kLargestProbe) return fmt::format("{} Å is too large; use at most {} Å", radius, kLargestProbe);
  return {};
}

double growth_of(SurfaceKind kind, double probe_radius) { return kind == SurfaceKind::sas ? probe_radius : 0.0; }

double rolling_probe(SurfaceKind kind, double probe_radius) { return kind == SurfaceKind::ses ? probe_radius : 0.0; }

std::vector<Ball> grown(std::span<const Ball> balls, double growth) {
  std::vector<Ball> larger(balls.begin(), balls.end());
  for (Ball& ball : larger) ball.radius += growth;
  return larger;
}

void require_probe_of_kind(const SurfaceRequest& request) {
  if (request.kind == SurfaceKind::vdw && request.probe_named)
    throw RequestError(message("@probe@: the van der Waals surface has no probe; leave @probe@ or @surface vdw@ out"));
}

namespace {

/// Returns the device that verifies. Any GL is sufficient, but hardware is faster.
DeviceChoice gl_for_verifying(const SurfaceRequest& request) {
  DeviceChoice choice = request.gl;
  choice.kind = DeviceChoice::Kind::automatic;
  return choice;
}

// Throws an error that names every difference, because a bug report with only the first few is useless.
void require_equal(const Surface& a, const std::string& device_a, const Surface& b, const std::string& device_b) {
  const std::vector<std::string> found = differences(a, b);
  if (found.empty()) return;
  throw OpenSurfaceError(message("@verify@: {} differences between {} and {}: {}", found.size(), device_a, device_b,
                                 fmt::join(found, "; ")));
}

}  // namespace

SurfaceComputer::SurfaceComputer(const SurfaceRequest& request, const EglContext* context)
    : request_(request),
      context_(context),
      thread_limit_(request.threads),
      on_cpu_(request.cpu),
      clock_(request.timing) {
  require_probe_of_kind(request);
  if (!request.cpu && request.gl.kind == DeviceChoice::Kind::automatic) on_cpu_ = !find_hardware();
}

// The automatic choice is never software GL. A list of devices does not show it: only a context knows its renderer.
bool SurfaceComputer::find_hardware() {
  if (context_) return !context_->is_software();
  DeviceChoice hardware = request_.gl;
  hardware.kind = DeviceChoice::Kind::gpu;
  try {
    engine_ = make_gpu_engine(hardware);
    return true;
  } catch (const GpuError&) {
    return false;  // EGL or a GPU is missing, or has no GL 4.5
  }
}

SurfaceComputer::~SurfaceComputer() = default;

std::unique_ptr<ReducedSurfaceEngine> SurfaceComputer::make_engine(bool on_cpu, const DeviceChoice& gl) const {
  if (on_cpu) return make_cpu_engine();
  return context_ ? make_gpu_engine(*context_) : make_gpu_engine(gl);
}

Surface SurfaceComputer::compute(std::span<const Ball> balls) {
  std::vector<Ball> larger;
  if (const double growth = growth_of(request_.kind, request_.probe_radius); growth > 0.0) {
    larger = grown(balls, growth);
    balls = larger;
  }
  const double probe_radius = rolling_probe(request_.kind, request_.probe_radius);
  if (!engine_) engine_ = make_engine(on_cpu_, request_.gl);
  const ClipPlanes planes = request_.verify ? ClipPlanes::listed : request_.planes;
  Surface surface = request_.bordered || !is_on_cpu() ? compute_surface(*engine_, balls, probe_radius, clock_, planes)
                                                      : compute_without_borders(balls, probe_radius, planes, clock_);
  device_ = engine_->device();
  if (request_.verify) verify(surface, balls, probe_radius);
  return surface;
}

void SurfaceComputer::verify(const Surface& surface, std::span<const Ball> balls, double probe_radius) {
  if (!verifier_) verifier_ = make_engine(!on_cpu_, gl_for_verifying(request_));
  StageClock unused;  // the time of the other device is not reported
  const Surface other = compute_surface(*verifier_, balls, probe_radius, unused);
  require_equal(surface, engine_->device(), other, verifier_->device());
  if (surface.certificate.closed && request_.check) request_.check(surface);
  device_ = fmt::format("{}, verified on {}", engine_->device(), verifier_->device());
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
