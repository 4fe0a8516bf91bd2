// SPDX-License-Identifier: BSD-3-Clause
// Computes surfaces from arrays, on the calling thread or, if GL may be needed, on a GL thread.

#include "core/mesh/compare_mesh.h"
#include "core/mesh/tessellate.h"
#include "core/scene/surface_computer.h"
#include "core/surface/compute_surface.h"
#include "exporters/bindings/c/c_calls.h"
#include "exporters/bindings/c/c_surface.h"

namespace meniscus::c_api {
namespace {

constexpr std::int32_t kMostThreads = 4096;

const meniscus_options kDefaultOptions{
    sizeof(meniscus_options), SurfaceRequest{}.probe_radius, MENISCUS_SES, MENISCUS_CPU, 0, 0};

void check_probe(double radius) {
  if (!std::isfinite(radius)) refuse(MENISCUS_INPUT, "probe_radius is {}, not a finite number", radius);
  const std::string fault = probe_fault(radius);
  if (!fault.empty()) refuse(MENISCUS_INPUT, "probe_radius: {}", fault);
  if (radius == 0.0)
    refuse(MENISCUS_INPUT,
           "probe_radius is 0; set it (MENISCUS_OPTIONS_INIT has {} Å), or choose MENISCUS_VDW, which has no probe",
           kDefaultOptions.probe_radius);
}

/// Returns the options of a caller, or the defaults for NULL. Refuses impossible options.
meniscus_options checked(const meniscus_options* given) {
  const meniscus_options options = read_options(given, kDefaultOptions, "meniscus_options");
  if (options.kind < MENISCUS_SES || options.kind > MENISCUS_VDW)
    refuse(MENISCUS_USAGE, "kind is {}, none of MENISCUS_SES, _SAS, _VDW", static_cast<std::int32_t>(options.kind));
  check_device(options.device);
  if (options.threads < 0 || options.threads > kMostThreads)
    refuse(MENISCUS_USAGE, "threads is {}; 0 means all, otherwise up to {}", options.threads, kMostThreads);
  if (options.kind != MENISCUS_VDW) check_probe(options.probe_radius);
  return options;
}

SurfaceKind kind_of(meniscus_kind kind) {
  return kind == MENISCUS_SES ? SurfaceKind::ses : kind == MENISCUS_SAS ? SurfaceKind::sas : SurfaceKind::vdw;
}

SurfaceRequest request_of(const meniscus_options& options) {
  SurfaceRequest result;
  result.kind = kind_of(options.kind);
  result.probe_radius = options.probe_radius;
  result.cpu = options.device == MENISCUS_CPU;
  result.gl = gl_of(options.device);
  result.verify = options.verify != 0;
  result.planes = ClipPlanes::deferred;
  result.check = check_by_mesh;
  return result;
}

}  // namespace
}  // namespace meniscus::c_api

/// The object behind the handle of a computer. It computes on the CPU or on a GL thread.
struct meniscus_computer : meniscus::c_api::Counted {
 public:
  explicit meniscus_computer(const meniscus_options& options) : options_(options) {
    const auto create = [&] {
      return std::make_unique<meniscus::SurfaceComputer>(meniscus::c_api::request_of(options));
    };
    if (options.device == MENISCUS_CPU && !options.verify)
      cpu_computer_ = create();
    else
      gl_computer_.emplace(create);
  }

  std::unique_ptr<const meniscus::c_api::FinishedSurface> compute(const std::vector<meniscus::Ball>& balls) {
    const std::lock_guard lock(mutex_);
    auto finished = std::make_unique<meniscus::c_api::FinishedSurface>();
    const auto run = [&](meniscus::SurfaceComputer& computer) {
      meniscus::c_api::run_on_threads(options_.threads, [&] { finished->surface = computer.compute(balls); });
      finished->device = computer.device();
    };
    if (gl_computer_)
      gl_computer_->run(run);
    else
      run(*cpu_computer_);
    require_closed(finished->surface);
    finished->kind = meniscus::c_api::kind_of(options_.kind);
    finished->probe_radius = options_.kind == MENISCUS_VDW ? 0.0 : options_.probe_radius;
    finished->threads = options_.threads;
    return finished;
  }

 private:
  const meniscus_options options_;
  std::mutex mutex_;
  std::unique_ptr<meniscus::SurfaceComputer> cpu_computer_;
  std::optional<meniscus::c_api::OnGlThread<meniscus::SurfaceComputer>> gl_computer_;
};

meniscus_status meniscus_default_options(meniscus_options* options) {
  using namespace meniscus::c_api;
  return guarded([&] { write_struct(options, kDefaultOptions, "meniscus_options"); });
}

meniscus_status meniscus_computer_new(const meniscus_options* options, meniscus_computer** computer) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(computer, "computer");
    *computer = new meniscus_computer(checked(options));
  });
}

meniscus_computer* meniscus_computer_retain(meniscus_computer* computer) { return meniscus::c_api::retain(computer); }
void meniscus_computer_release(meniscus_computer* computer) { meniscus::c_api::release(computer); }

meniscus_status meniscus_compute(meniscus_computer* computer, const meniscus_atoms* atoms, meniscus_surface** surface) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(computer, "computer");
    require(surface, "surface");
    auto fresh = std::make_unique<meniscus_surface>();
    fresh->finished = computer->compute(read_atoms(atoms));
    *surface = fresh.release();
  });
}

meniscus_status meniscus_recompute(meniscus_computer* computer, const meniscus_atoms* atoms,
                                   meniscus_surface** surface) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(computer, "computer");
    require(surface, "surface");
    require(*surface, "*surface");
    auto finished = computer->compute(read_atoms(atoms));
    if ((*surface)->has_one_reference()) {
      (*surface)->finished = std::move(finished);
      return;
    }
    auto fresh = std::make_unique<meniscus_surface>();
    fresh->finished = std::move(finished);
    release(std::exchange(*surface, fresh.release()));
  });
}
