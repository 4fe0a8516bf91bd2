// SPDX-License-Identifier: BSD-3-Clause
// Computes cut lists and cusp arcs on the CPU. The order of probes decides on one spindle circle, a pencil.
#include "core/surface/cusp_tracer.h"

#include <iterator>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/math/ball.h"
#include "core/reduced_surface/contour/contour.h"

namespace meniscus {
namespace {

constexpr double kThroughCusp = 1e-7;  // Å²: an upper limit of the shift of a sphere by decision weights
constexpr double kHair = 1e-6;         // relative to the circle's radius

}  // namespace

bool reaches(const CuspProblem& problem, std::uint32_t s, const glm::dvec3& other) {
  const glm::dvec3 toward = other - problem.positions[s];
  const double distance = glm::length(toward);
  if (!(distance > 0)) return false;
  const glm::dvec3 d = toward / distance;
  const auto sides = problem.sides_of(s);
  geometry::PolygonReach reach = geometry::no_reach();
  for (std::size_t n = 0; n < sides.size(); ++n)
    geometry::add_side(reach, sides[n].contact, sides[n + 1 == sides.size() ? 0 : n + 1].contact, d);
  return geometry::reaches_bisector(reach, problem.probe_radius, distance);
}

void correct_neighbors(const CuspProblem& problem, CutLists& cuts) {
  CutLists corrected;
  corrected.first.assign(1, 0);
  corrected.probe.reserve(cuts.probe.size());
  std::vector<std::uint32_t> list;
  for (std::uint32_t s = 0; s < problem.count(); ++s) {
    const auto known = cuts.of(s);
    list.assign(known.begin(), known.end());
    for (const CuspSide& side : problem.sides_of(s)) {
      if (side.partner != kNone && side.partner != s && !side.touching) list.push_back(side.partner);
      if (side.apart != kNone) std::erase(list, side.apart);
    }
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    corrected.probe.insert(corrected.probe.end(), list.begin(), list.end());
    corrected.first.push_back(static_cast<std::uint32_t>(corrected.probe.size()));
  }
  cuts = std::move(corrected);
}

bool are_mutual(const CutLists& cuts, std::uint32_t s, std::uint32_t t) {
  const auto back = cuts.of(t);
  return std::binary_search(back.begin(), back.end(), s);
}

std::vector<std::array<std::uint32_t, 2>> mutual_pairs(const CutLists& cuts) {
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::uint32_t s = 0; s + 1 < cuts.first.size(); ++s)
    for (std::uint32_t t : cuts.of(s))
      if (t > s && are_mutual(cuts, s, t)) pairs.push_back({s, t});
  return pairs;
}

// The spindle circles that a pair of probes shares.
struct Pencils {
  using uint = std::uint32_t;
  const CuspProblem* problem = nullptr;
  std::vector<uint> pencil_sides;

  bool reserve_pencils(uint count) {
    if (pencil_sides.size() < count) pencil_sides.resize(count);
    return true;
  }
  uint first_side(uint probe) const { return problem->first_side[probe]; }
  uint circle_of(uint side) const { return problem->sides[side].circle; }
  uint partner_of(uint side) const { return problem->sides[side].partner; }
#include "gpu_shaders/geometry/pencil.glsl"

  std::span<const uint> all() const { return {pencil_sides.data(), pencil_count}; }
};

// The point where the pair's circle meets the axis of a pencil, relative to the lower probe, and the direction in which
// the circle continues before the axis.
struct AxisPoint {
  glm::dvec3 point;
  glm::dvec3 onwards;
};

struct PairTracer::Scratch {
  Pencils pencils;
  std::vector<AxisPoint> axis_points;
  Blockers others;
  std::vector<BlockedHalf> halves;
  Contour contour;
};

PairTracer::PairTracer(const CuspProblem& problem, const CutLists& cuts)
    : problem_(&problem), cuts_(&cuts), scratch_(std::make_unique<Scratch>()) {
  scratch_->pencils.problem = &problem;
}
PairTracer::~PairTracer() = default;
PairTracer::PairTracer(PairTracer&&) noexcept = default;

// Removes the pair's circle past the axis of a shared spindle circle. False if that is all of it.
bool PairTracer::set_halves(std::uint32_t s, std::uint32_t t) {
  scratch_->halves.clear();
  scratch_->axis_points.clear();
  if (scratch_->pencils.all().empty()) return true;
  const glm::dvec3 d = problem_->positions[t] - problem_->positions[s];
  const geometry::Circle circle = geometry::circle_of_two_spheres(d, problem_->weights[s], problem_->weights[t]);
  for (const std::uint32_t pencil : scratch_->pencils.all()) {
    const CuspSide& side = problem_->sides[pencil];
    BlockedHalf half;
    half.label = kAxisLabel | pencil;
    half.half_plane =
        geometry::half_plane_past_axis(circle, side.gap_direction, side.circle_center - problem_->positions[s]);
    double margin = 0;
    const int meeting = geometry::meet_axis(half.half_plane, side.touching, margin);
    if (meeting == geometry::kCovers) return false;
    if (meeting == geometry::kCuts) {
      scratch_->halves.push_back(half);
      const geometry::CoveredArc past = geometry::covered_arc(half.half_plane);
      for (const double sign : {1.0, -1.0}) {
        const glm::dvec2 e = geometry::direction_at(sign > 0 ? past.end : past.begin);
        scratch_->axis_points.push_back(
            {circle.axis * circle.height + circle.radius * (e.x * circle.u + e.y * circle.v),
             sign * (e.x * circle.v - e.y * circle.u)});
      }
    }
  }
  return true;
}

// Lists the other probes that may cover part of the pair's circle. Another probe may pass through an axis cusp but
// cannot contain it (theorem 1.2), so the pair's circle begins there in spite of rounding. A probe that takes over
// exactly at the cusp is compared with a circle that begins slightly before it.
void PairTracer::list_others(std::uint32_t s, std::uint32_t t, const Blockers& near) {
  Scratch& scratch = *scratch_;
  scratch.others.restart(problem_->weights[s]);
  const double squared = problem_->probe_radius * problem_->probe_radius;
  const auto of_s = cuts_->of(s), of_t = cuts_->of(t);
  const auto cuts_both = [&](std::uint32_t u) {
    return std::binary_search(of_s.begin(), of_s.end(), u) && std::binary_search(of_t.begin(), of_t.end(), u);
  };
  bool taken_over = false;
  for (std::size_t n = 0; n < near.size(); ++n) {
    const Blockers::Ball& b = near[n];
    if (b.label == t || !cuts_both(b.label) || scratch.pencils.on_pencil(b.label)) continue;
    bool beyond_axis = false;
    for (const AxisPoint& axis : scratch.axis_points) {
      const glm::dvec3 d = axis.point - b.center;
      if (std::abs(glm::dot(d, d) - squared) > kThroughCusp * std::max(1.0, problem_->probe_radius)) continue;
      (glm::dot(d, axis.onwards) < 0 ? taken_over : beyond_axis) = true;
    }
    if (!beyond_axis) scratch.others.add(b.center, b.weight, b.label);
  }
  if (taken_over)
    for (BlockedHalf& half : scratch.halves) half.half_plane.offset += kHair;
}

void PairTracer::trace(std::uint32_t s, std::uint32_t t, const Blockers& near, std::vector<TracedArc>& found) {
  if (!scratch_->pencils.find_pencils(s, t) || !set_halves(s, t)) return;
  list_others(s, t, near);
  Scratch& scratch = *scratch_;
  scratch.contour.expose(problem_->positions[t] - problem_->positions[s], problem_->weights[t], scratch.others,
                         scratch.others.size(), scratch.halves);
  const Contour& contour = scratch.contour;
  if (contour.whole()) found.push_back({{s, t}, {kNone, kNone}, contour.circle().u, contour.circle().u});
  for (const ExposedArc& arc : contour.arcs())
    found.push_back({{s, t}, {arc.begin_by, arc.end_by}, contour.direction(arc.begin), contour.direction(arc.end)});
}

namespace {

class CpuCuspTracer final : public CuspTracer {
 public:
  CutLists list_cuts(const CuspProblem& problem) override {
    grid_ = std::make_unique<BallGrid>(problem.positions, problem.probe_radius);
    // The number of probes in a chunk of the grid's order. Each chunk has one list, and each probe's part of it is
    // sorted at once.
    constexpr std::uint32_t kChunk = 64;
    const std::vector<std::uint32_t>& order = grid_->order();
    const std::uint32_t count = problem.count(), chunks = (count + kChunk - 1) / kChunk;
    const auto probes_of = [&](std::uint32_t chunk) {
      return std::span(order).subspan(chunk * kChunk, std::min(kChunk, count - chunk * kChunk));
    };
    std::vector<std::vector<std::uint32_t>> cuts(chunks);
    CutLists lists;
    lists.first.assign(count + 1, 0);
    tbb::parallel_for(std::uint32_t{0}, chunks, [&](std::uint32_t chunk) {
      std::vector<std::uint32_t>& list = cuts[chunk];
      for (const std::uint32_t s : probes_of(chunk)) {
        if (!problem.low(s)) continue;
        const std::ptrdiff_t before = std::ssize(list);
        grid_->for_each_near(problem.positions[s], 2 * problem.probe_radius, [&](std::uint32_t t) {
          if (t != s && reaches(problem, s, problem.positions[t])) list.push_back(t);
        });
        std::sort(list.begin() + before, list.end());
        lists.first[s + 1] = static_cast<std::uint32_t>(std::ssize(list) - before);
      }
    });
    for (std::uint32_t s = 0; s < count; ++s) lists.first[s + 1] += lists.first[s];
    lists.probe.resize(lists.first.back());
    for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) {
      auto next = cuts[chunk].cbegin();
      for (const std::uint32_t s : probes_of(chunk)) {
        const auto past = next + (lists.first[s + 1] - lists.first[s]);
        std::copy(next, past, lists.probe.begin() + lists.first[s]);
        next = past;
      }
    }
    return lists;
  }

  std::vector<TracedArc> trace(const CuspProblem& problem, const CutLists& cuts) override {
    struct Worker {
      Worker(const CuspProblem& problem, const CutLists& cuts) : tracer(problem, cuts) {}
      PairTracer tracer;
      Blockers near;
      std::vector<TracedArc> found;
    };
    const std::vector<std::uint32_t>& order = grid_->order();
    tbb::enumerable_thread_specific<Worker> workers([&] { return Worker(problem, cuts); });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, order.size(), 32), [&](const auto& range) {
      Worker& w = workers.local();
      for (std::size_t n = range.begin(); n != range.end(); ++n) {
        const std::uint32_t s = order[n];
        bool is_listed = false;
        for (const std::uint32_t t : cuts.of(s)) {
          if (t < s || !are_mutual(cuts, s, t)) continue;
          if (!std::exchange(is_listed, true)) list_near(problem, s, w.near);
          w.tracer.trace(s, t, w.near, w.found);
        }
      }
    });
    std::vector<TracedArc> found;
    for (const Worker& w : workers) found.insert(found.end(), w.found.begin(), w.found.end());
    return found;
  }

 private:
  void list_near(const CuspProblem& problem, std::uint32_t s, Blockers& near) const {
    near.restart(problem.weights[s]);
    grid_->for_each_near(problem.positions[s], 2 * problem.probe_radius + 4e-9, [&](std::uint32_t u) {
      if (u != s) near.add(problem.positions[u] - problem.positions[s], problem.weights[u], u);
    });
    near.sort();
  }

  std::unique_ptr<BallGrid> grid_;
};

}  // namespace

std::unique_ptr<CuspTracer> make_cpu_cusp_tracer() { return std::make_unique<CpuCuspTracer>(); }

}  // namespace meniscus
