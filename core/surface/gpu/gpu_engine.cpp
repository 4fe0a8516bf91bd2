// SPDX-License-Identifier: BSD-3-Clause
// Arcs of all atoms, the atoms that have none, and the way of both to the host.
#include "core/surface/gpu/gpu_engine.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <tbb/parallel_sort.h>

#include "core/base/error.h"
#include "core/gpu/append_list.h"
#include "core/gpu/egl_context.h"
#include "core/gpu/gpu_stage.h"
#include "core/gpu/kernel_parameters.h"
#include "core/reduced_surface/gpu/gpu_arcs.h"
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
    {
      const GpuStage stage(clock, "grid");
      arcs_.upload(atoms, swallowed_atoms(atoms), probe_radius);
    }
    lone_atoms_.clear();
    arcs_.find(clock, [&](const BallBatch& batch) { list_lone_atoms(batch); });
    // Some atom is exposed, whatever the atoms: with arcs, or as a whole.
    if (arcs_.circles.arcs.count() == 0 && lone_atoms_.count() == 0)
      throw GpuError("the GPU finds no surface at all, which cannot be; run again, or on another --device");
    const GpuStage stage(clock, "sort arcs");
    ReducedSurface rs{arcs_.circles.arcs.buffer.download<RsArc>(arcs_.circles.arcs.count()),
                      lone_atoms_.buffer.download<std::uint32_t>(lone_atoms_.count())};
    tbb::parallel_sort(rs.arcs.begin(), rs.arcs.end());
    std::sort(rs.lone_atoms.begin(), rs.lone_atoms.end());
    return rs;
  }

  CuspTracer& cusp_tracer() override { return *cusp_tracer_; }
  const CircleStats& stats() const override { return arcs_.circles.stats(); }
  std::string device() const override { return device_; }

 private:
  void list_lone_atoms(const BallBatch& batch) {
    const Program& program = programs_.get("gpu_shaders/reduced_surface/lone_atoms.comp");
    std::array<std::uint32_t, 1> counts{};
    append_all({&lone_atoms_}, counters_, counts, [&] {
      arcs_.circles.atoms.bind(0);
      arcs_.neighbors.balls_low.bind(1);
      arcs_.neighbors.first.bind(2);
      arcs_.neighbors.labels.bind(3);
      lone_atoms_.buffer.bind(4);
      counters_.bind(5);
      program.set(kernel::LoneAtomParameters{
          .first_entry = batch.first, .entry_count = batch.count, .capacity = lone_atoms_.capacity()});
      program.dispatch(group_count(batch.count));
    });
  }

  std::unique_ptr<EglContext> own_;  // ends last
  std::string device_;
  ProgramCache programs_;
  GpuArcs arcs_{programs_};
  AppendList lone_atoms_{sizeof(std::uint32_t), 1 << 12};
  Buffer counters_;
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
