// SPDX-License-Identifier: BSD-3-Clause
// Arcs of all atoms and their way to the host.
#include "core/surface/gpu/gpu_engine.h"

#include <utility>
#include <vector>

#include <tbb/parallel_sort.h>

#include "core/base/error.h"
#include "core/gpu/egl_context.h"
#include "core/gpu/gpu_stage.h"
#include "core/reduced_surface/gpu/gpu_arcs.h"
#include "core/reduced_surface/whole_spheres.h"
#include "core/surface/gpu/gpu_cusp_tracer.h"

namespace meniscus {
namespace {

class GpuEngine final : public ReducedSurfaceEngine {
 public:
  /// own: this very context, if it shall end with the engine.
  explicit GpuEngine(const EglContext& context, std::unique_ptr<EglContext> own = {})
      : own_(std::move(own)),
        device_(context.renderer() + ", GL " + context.version()),
        cusp_tracer_(make_gpu_cusp_tracer(programs_)) {}

  ReducedSurface reduce(std::span<const Ball> atoms, double probe_radius, StageClock& clock) override {
    if (atoms.empty()) return {};
    double protruding = 0;
    const std::vector<bool> swallowed = swallowed_atoms(atoms, &protruding);
    {
      const GpuStage stage(clock, "grid");
      arcs_.upload(atoms, swallowed, probe_radius, true);
    }
    arcs_.find(clock);
    ReducedSurface rs;
    {
      const GpuStage stage(clock, "sort arcs");
      rs.arcs = arcs_.circles.arcs.buffer.download<RsArc>(arcs_.circles.arcs.count());
      tbb::parallel_sort(rs.arcs.begin(), rs.arcs.end());
    }
    const auto stage = clock.stage("spheres without arcs");
    find_whole_spheres(atoms, arcs_.weights(), swallowed, rs);
    rs.exact_within = decided_within(growth_as_roundoff(arcs_.weights()), stats().ties, protruding);
    // Some atom is exposed, whatever the atoms: with arcs, or as a whole.
    if (rs.arcs.empty() && rs.lone_atoms.empty())
      throw GpuError("the GPU finds no surface at all, which cannot be; run again, or on another --device");
    return rs;
  }

  CuspTracer& cusp_tracer() override { return *cusp_tracer_; }
  const CircleStats& stats() const override { return arcs_.circles.stats(); }
  std::string device() const override { return device_; }

 private:
  std::unique_ptr<EglContext> own_;  // ends last
  std::string device_;
  ProgramCache programs_;
  GpuArcs arcs_{programs_};
  std::unique_ptr<CuspTracer> cusp_tracer_;
};

}  // namespace

std::unique_ptr<ReducedSurfaceEngine> make_gpu_engine(const EglContext& context) {
  return std::make_unique<GpuEngine>(context);
}

std::unique_ptr<ReducedSurfaceEngine> make_gpu_engine(const DeviceChoice& choice) {
  auto own = std::make_unique<EglContext>(choice);
  const EglContext& context = *own;
  return std::make_unique<GpuEngine>(context, std::move(own));
}

}  // namespace meniscus
