// SPDX-License-Identifier: BSD-3-Clause
// Runs the kernels for the reduced surface and for cusps, and reads their lists back.
#include "core/surface/compute_surface.h"

#include <tbb/parallel_sort.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/gpu/egl_context.h"
#include "core/gpu/kernel_lists.h"
#include "core/gpu/kernel_records.h"
#include "core/gpu/program.h"
#include "core/reduced_surface/contour/contour.h"
#include "core/reduced_surface/gpu/gpu_arcs.h"
#include "core/reduced_surface/gpu/gpu_neighbors.h"
#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {
namespace {

class GpuEngine final : public ReducedSurfaceEngine {
 public:
  /// own: this context, if the engine is to destroy it.
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
    // For any atoms, some atom is exposed: with arcs, or as a whole.
    if (rs.arcs.empty() && rs.lone_atoms.empty())
      throw GpuError(message("the GPU found no surface, which is impossible; run again, or choose another @device@"));
    return rs;
  }

  CuspTracer& cusp_tracer() override { return *cusp_tracer_; }
  const CircleStats& stats() const override { return arcs_.circles.stats(); }
  std::string device() const override { return device_; }

 private:
  std::unique_ptr<EglContext> own_;  // destroyed last
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

namespace {

using kernel::CuspArcRecord;
using kernel::SideRecord;

constexpr std::size_t kArcHeader = 16;  // bytes of counters before the arcs

class GpuCuspTracer final : public CuspTracer {
 public:
  explicit GpuCuspTracer(ProgramCache& programs) : programs_(programs), neighbors_(programs) {}

  CutLists list_cuts(const CuspProblem& problem) override {
    upload(problem);
    CutLists cuts;
    cuts.first.assign(1, 0);
    neighbors_.for_each_batch([&](const BallBatch& batch) {
      flags_.resize(std::max(1u, batch.neighbor_count) * sizeof(std::uint32_t));
      flags_.fill(2);  // an entry that a driver leaves out because it cuts loops short is in doubt
      neighbors_.first.bind(0);
      neighbors_.relative.bind(1);
      heads_.bind(2);
      sides_.bind(3);
      flags_.bind(4);
      const Program& program = programs_.get("gpu_shaders/singularities/cuts.comp");
      program.set(kernel::CutParameters{.first_probe = batch.first,
                                        .probe_count = batch.count,
                                        .probe_radius = static_cast<float>(problem.probe_radius)});
      program.dispatch(group_count(batch.count));
      collect_cuts(problem, batch, cuts);
    });
    return cuts;
  }

  std::vector<TracedArc> trace(const CuspProblem& problem, const CutLists& cuts) override {
    const auto pairs = mutual_pairs(cuts);
    std::vector<TracedArc> found;
    auto next = pairs.begin();
    if (pairs.empty()) return found;
    neighbors_.for_each_batch([&](const BallBatch& batch) {
      const auto first = neighbors_.first.download<std::uint32_t>(batch.count + 1);
      const auto labels = neighbors_.labels.download<std::uint32_t>(batch.neighbor_count);
      std::vector<glm::uvec2> circles;
      for (; next != pairs.end() && (*next)[0] < batch.first + batch.count; ++next) {
        const std::uint32_t entry = (*next)[0] - batch.first;
        const auto place = std::find(labels.begin() + first[entry], labels.begin() + first[entry + 1], (*next)[1]);
        circles.push_back({(*next)[0], static_cast<std::uint32_t>(place - labels.begin())});
      }
      if (circles.empty()) return;
      run_circles(batch, circles, found);
      if (doubtful_.count() == 0) return;
      PairTracer tracer(problem, cuts);
      for (const glm::uvec2& circle : doubtful_.buffer.download<glm::uvec2>(doubtful_.count()))
        trace_on_host(problem, batch, circle, first, labels, tracer, found);
    });
    return found;
  }

 private:
  void upload(const CuspProblem& problem) {
    neighbors_.upload(problem.positions, std::vector<double>(problem.count(), problem.probe_radius), {});
    std::vector<glm::uvec2> heads(problem.count() + 1);
    std::vector<SideRecord> sides(problem.sides.size());
    for (std::uint32_t s = 0; s < problem.count(); ++s) {
      heads[s] = {problem.first_side[s], problem.low(s) ? 1u : 0u};
      for (std::uint32_t n = problem.first_side[s]; n < problem.first_side[s + 1]; ++n) {
        const CuspSide& side = problem.sides[n];
        sides[n] = {glm::vec4(glm::vec3(side.contact), 0),
                    glm::vec4(glm::vec3(side.gap_direction), 0),
                    glm::vec4(glm::vec3(side.circle_center - problem.positions[s]), 0),
                    side.circle,
                    side.partner,
                    side.touching ? 1u : 0u,
                    0u};
      }
    }
    heads.back() = {static_cast<std::uint32_t>(sides.size()), 0u};
    heads_.upload(heads);
    sides_.upload(sides);
  }

  void collect_cuts(const CuspProblem& problem, const BallBatch& batch, CutLists& cuts) const {
    const auto first = neighbors_.first.download<std::uint32_t>(batch.count + 1);
    const auto labels = neighbors_.labels.download<std::uint32_t>(batch.neighbor_count);
    const auto flags = flags_.download<std::uint32_t>(batch.neighbor_count);
    for (std::uint32_t entry = 0; entry < batch.count; ++entry) {
      for (std::uint32_t n = first[entry]; n < first[entry + 1]; ++n)
        if (flags[n] == 1 || (flags[n] == 2 && reaches(problem, batch.first + entry, problem.positions[labels[n]])))
          cuts.probe.push_back(labels[n]);
      std::sort(cuts.probe.begin() + cuts.first.back(), cuts.probe.end());
      cuts.first.push_back(static_cast<std::uint32_t>(cuts.probe.size()));
    }
  }

  // Appends the arcs that the kernel finds; lists the circles left in doubt.
  void run_circles(const BallBatch& batch, const std::vector<glm::uvec2>& circles, std::vector<TracedArc>& found) {
    circles_.upload(circles);
    arcs_.clear();
    doubtful_.clear();
    const Program& program = programs_.get("gpu_shaders/singularities/cusps.comp");
    std::array<std::uint32_t, 2> counts{};  // numbers of arcs and of doubtful circles
    append_all({&arcs_, &doubtful_}, arcs_.buffer, counts, [&] {
      circles_.bind(0);
      neighbors_.first.bind(1);
      neighbors_.labels.bind(2);
      neighbors_.relative.bind(3);
      heads_.bind(4);
      sides_.bind(5);
      arcs_.buffer.bind(6);
      doubtful_.buffer.bind(7);
      program.set(kernel::CuspParameters{.first_probe = batch.first,
                                         .circle_count = static_cast<std::uint32_t>(circles.size()),
                                         .arc_capacity = arcs_.capacity(),
                                         .doubtful_capacity = doubtful_.capacity()});
      program.dispatch(group_count(circles.size()));
    });
    for (const CuspArcRecord& arc : arcs_.buffer.download<CuspArcRecord>(arcs_.count(), kArcHeader))
      found.push_back(
          {{arc.names.x, arc.names.y}, {arc.names.z, arc.names.w}, glm::dvec3(arc.begin), glm::dvec3(arc.end)});
  }

  static void trace_on_host(const CuspProblem& problem, const BallBatch& batch, const glm::uvec2& circle,
                            const std::vector<std::uint32_t>& first, const std::vector<std::uint32_t>& labels,
                            PairTracer& tracer, std::vector<TracedArc>& found) {
    const std::uint32_t s = circle.x, entry = s - batch.first;
    Blockers near;
    near.restart(problem.weights[s]);
    for (std::uint32_t n = first[entry]; n < first[entry + 1]; ++n)
      near.add(problem.positions[labels[n]] - problem.positions[s], problem.weights[labels[n]], labels[n]);
    tracer.trace(s, labels[circle.y], near, found);
  }

  ProgramCache& programs_;
  GpuNeighbors neighbors_;
  Buffer heads_, sides_, flags_, circles_;
  AppendList arcs_{sizeof(CuspArcRecord), 1 << 12, kArcHeader}, doubtful_{sizeof(glm::uvec2), 1 << 12};
};

}  // namespace

std::unique_ptr<CuspTracer> make_gpu_cusp_tracer(ProgramCache& programs) {
  return std::make_unique<GpuCuspTracer>(programs);
}

}  // namespace meniscus
