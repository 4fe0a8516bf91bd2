// SPDX-License-Identifier: BSD-3-Clause
// Finds cusp curves with a tracer, keeps the arcs that lie on patches, and joins them at their ends.
#include "core/surface/cusps.h"

#include <numbers>
#include <tuple>
#include <utility>

#include <tbb/blocked_range.h>

#include "core/math/double_geometry.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/parallel_tables.h"
#include "core/surface/reduced_components.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr double kUnbounded = std::numeric_limits<double>::infinity();
// Å for a probe of radius 0: the largest shift of a point by merging (fixed_probes.h).
const double kBlur = geometry::kMergeDistance;

struct FoundArc {
  CuspArc arc;
  std::array<std::uint32_t, 2> by{kNone, kNone};
};

// The end of a cusp arc at which three probes meet.
struct TripleEnd {
  std::array<std::uint32_t, 3> probe;
  std::uint32_t side;
  std::uint32_t arc_and_end;
};

double angle_between(const glm::dvec3& axis, const glm::dvec3& a, const glm::dvec3& b) {
  const double angle = std::atan2(glm::dot(axis, glm::cross(a, b)), glm::dot(a, b));
  return angle < 0 ? angle + kTwoPi : angle;
}

class CuspSearch {
 public:
  CuspSearch(std::span<const Ball> atoms, double probe_radius, const FixedProbes& probes,
             std::span<const ToroidalPatch> toroidal, const ReducedComponents* within)
      : atoms_(atoms),
        p_(probe_radius),
        probes_(probes),
        toroidal_(toroidal),
        within_(within),
        first_on_circle_(first_on_circle(toroidal, within)) {
    pose();
  }

  CuspParts run(CuspTracer& tracer) {
    find_gaps();
    CutLists cuts = tracer.list_cuts(problem_);
    if (within_) keep_cuts_within_components(cuts);
    correct_neighbors(problem_, cuts);
    adopt_all(tracer.trace(problem_, cuts));
    std::sort(found_.begin(), found_.end(), [](const FoundArc& a, const FoundArc& b) {
      return std::tie(a.arc.probe, a.by) < std::tie(b.arc.probe, b.by);
    });
    join_triples();
    parts_.first_cut = std::move(cuts.first);
    parts_.cuts = std::move(cuts.probe);
    parts_.first_on_circle = std::move(first_on_circle_);
    return std::move(parts_);
  }

 private:
  void keep_cuts_within_components(CutLists& cuts) const {
    CutLists kept;
    kept.first.assign(1, 0);
    for (std::uint32_t s = 0; s < problem_.count(); ++s) {
      for (const std::uint32_t t : cuts.of(s))
        if (within_->of_probe[s] == within_->of_probe[t]) kept.probe.push_back(t);
      kept.first.push_back(static_cast<std::uint32_t>(kept.probe.size()));
    }
    cuts = std::move(kept);
  }

  void pose() {
    problem_.probe_radius = p_;
    problem_.positions = probes_.position;
    problem_.heights = probes_.height;
    problem_.first_side = probes_.first_side;
    problem_.weights.resize(probes_.count());
    resize_large(problem_.sides, probes_.sides.size());
    tbb::parallel_for(std::size_t{0}, probes_.count(), [&](std::size_t s) {
      problem_.weights[s] = probe_decision_weight(p_, probes_.numbers.empty() ? s : probes_.numbers[s]);
      for (std::uint32_t n = probes_.first_side[s]; n < probes_.first_side[s + 1]; ++n) {
        if (n + kPrefetchAhead < probes_.sides.size()) {
          const ProbeSide& later = probes_.sides[n + kPrefetchAhead];
          prefetch(toroidal_, later.toroidal);
          prefetch(first_on_circle_, later.toroidal);
          prefetch(atoms_, later.from);
        }
        const ToroidalPatch& patch = toroidal_[probes_.sides[n].toroidal];
        CuspSide& side = problem_.sides[n];
        side.contact = glm::normalize(atoms_[probes_.sides[n].from].center - probes_.position[s]);
        side.circle_center = patch.center;
        if (patch.radius >= p_ && patch.sweep <= std::numbers::pi)
          side.apart = patch.probe[probes_.sides[n].at_end ? 0 : 1];
        if (!touches_axis(patch, atoms_, p_)) continue;
        side.circle = first_on_circle_[probes_.sides[n].toroidal];
        side.touching = patch.radius == p_;
      }
    });
  }

  // Finds, for each end of an arc of a spindle circle, the probe that ends the covered gap beyond it.
  void find_gaps() {
    std::vector<std::array<std::uint32_t, 2>> side_at(toroidal_.size());  // patch, end -> side
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, probes_.sides.size(), 1024), [&](const auto& range) {
      for (std::size_t n = range.begin(); n != range.end(); ++n)
        side_at[probes_.sides[n].toroidal][probes_.sides[n].at_end] = static_cast<std::uint32_t>(n);
    });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, toroidal_.size(), 1024), [&](const auto& range) {
      std::vector<std::pair<double, std::uint32_t>> around;
      for (std::size_t t = range.begin(); t != range.end(); ++t)
        if (first_on_circle_[t] == t) find_gaps_of(static_cast<std::uint32_t>(t), side_at, around);
    });
  }

  // Finds the gaps of the circle whose first arc is `first`; `around` is scratch memory.
  void find_gaps_of(std::uint32_t first, std::span<const std::array<std::uint32_t, 2>> side_at,
                    std::vector<std::pair<double, std::uint32_t>>& around) {
    const ToroidalPatch& lead = toroidal_[first];
    if (lead.free() || !touches_axis(lead, atoms_, p_)) return;
    around.clear();
    for (std::uint32_t t = first; t < toroidal_.size() && toroidal_[t].atom == lead.atom; ++t)
      if (first_on_circle_[t] == first)
        around.emplace_back(t == first ? 0.0 : angle_between(lead.axis, lead.start, toroidal_[t].start), t);
    std::sort(around.begin(), around.end());
    for (std::size_t n = 0; n < around.size(); ++n) {
      const std::uint32_t t = around[n].second, u = around[(n + 1) % around.size()].second;
      const double begin = around[n].first + toroidal_[t].sweep;
      const double end = around[(n + 1) % around.size()].first + (n + 1 == around.size() ? kTwoPi : 0.0);
      const double middle = 0.5 * (begin + end);
      const glm::dvec3 direction = arc_direction(lead, middle);
      CuspSide &last = problem_.sides[side_at[t][1]], &next = problem_.sides[side_at[u][0]];
      last.partner = toroidal_[u].probe[0];
      next.partner = toroidal_[t].probe[1];
      last.gap_direction = next.gap_direction = direction;
    }
  }

  // Keeps and places the traced arcs that lie on the patches.
  void adopt_all(const std::vector<TracedArc>& traced) {
    std::vector<FoundArc> arcs(traced.size());
    std::vector<DepthRange> depths(traced.size());
    tbb::parallel_for(std::size_t{0}, traced.size(), [&](std::size_t n) {
      arcs[n] = place(traced[n]);
      depths[n] = depth_on_both_patches(arcs[n].arc);
    });
    for (std::size_t n = 0; n < arcs.size(); ++n) {
      const auto& [lowest, highest] = depths[n];
      if (std::min(highest, -lowest) > kBlur * (1 + p_))
        parts_.open_probes.insert(parts_.open_probes.end(), traced[n].probe.begin(), traced[n].probe.end());
      // At the axis both patches have a corner, so the arc lies on them however short it is.
      const bool from_axis = arcs[n].arc.on_axis[0] || arcs[n].arc.on_axis[1];
      if (from_axis || highest > -lowest) found_.push_back(arcs[n]);
    }
  }

  FoundArc place(const TracedArc& traced) const {
    const auto [s, t] = traced.probe;
    const glm::dvec3 d = probes_.position[t] - probes_.position[s];
    FoundArc found;
    found.arc.probe = traced.probe;
    found.arc.axis = glm::normalize(d);
    found.arc.center = probes_.position[s] + 0.5 * d;
    found.arc.radius = std::sqrt(std::max(0.0, p_ * p_ - 0.25 * glm::dot(d, d)));
    found.arc.start = glm::normalize(traced.begin - found.arc.axis * glm::dot(found.arc.axis, traced.begin));
    found.arc.sweep = traced.by[0] == kNone ? kTwoPi : angle_between(found.arc.axis, found.arc.start, traced.end);
    found.by = traced.by;
    for (int end = 0; end < 2; ++end)
      if (traced.by[end] != kNone && (traced.by[end] & kAxisLabel))
        name_axis_cusp(found, end, end ? traced.end : traced.begin);
    return found;
  }

  void name_axis_cusp(FoundArc& found, int end, const glm::dvec3& direction) const {
    const std::uint32_t first = problem_.sides[found.by[end] & ~kAxisLabel].circle;
    const glm::dvec3 point = found.arc.center + found.arc.radius * direction;
    const bool upper = glm::dot(toroidal_[first].axis, point - toroidal_[first].center) > 0;
    found.arc.on_axis[end] = true;
    found.arc.vertex[end] = first * 2 + (upper ? 1 : 0);
  }

  struct DepthRange {
    double lowest = kUnbounded;
    double highest = -kUnbounded;
  };

  // Returns the depth of the circle's piece in the cones of both probes, Å. The piece lies on both patches throughout
  // or nowhere, so the clearest of three points decides; if the piece also has a point clearly on the other side, the
  // search for its ends failed. The ends lie on borders, so only the farthest point between them counts.
  DepthRange depth_on_both_patches(const CuspArc& arc) const {
    DepthRange range;
    for (const double part : {0.5, 0.3, 0.7}) {
      const glm::dvec3 point = arc_point(arc, part * arc.sweep);
      const double depth = std::min(depth_in_cone(arc.probe[0], point), depth_in_cone(arc.probe[1], point));
      range.lowest = std::min(range.lowest, depth);
      range.highest = std::max(range.highest, depth);
    }
    if (range.highest > -range.lowest)
      for (const std::uint32_t s : arc.probe) range.lowest = std::min(range.lowest, least_depth(arc, s));
    return range;
  }

  // Returns the depth of the piece's farthest point beyond a side of the probe's cone, if that point is not an end.
  double least_depth(const CuspArc& arc, std::uint32_t s) const {
    double least = kUnbounded;
    for_each_side(s, [&](const glm::dvec3& normal) {
      const double along = glm::dot(normal, arc.axis), across = std::sqrt(std::max(0.0, 1 - along * along));
      if (arc.sweep < kTwoPi && angle_between(arc.axis, arc.start, normal) > arc.sweep) return;
      least = std::min(least, -glm::dot(normal, arc.center - probes_.position[s]) - arc.radius * across);
    });
    return least;
  }

  double depth_in_cone(std::uint32_t s, const glm::dvec3& point) const {
    double depth = kUnbounded;
    for_each_side(
        s, [&](const glm::dvec3& normal) { depth = std::min(depth, -glm::dot(normal, point - probes_.position[s])); });
    return depth;
  }

  // Visits the unit normals of the planes through the probe and two neighbouring contacts; they point out of the cone.
  template <typename Visit>
  void for_each_side(std::uint32_t s, const Visit& visit) const {
    const auto sides = problem_.sides_of(s);
    for (std::size_t n = 0; n < sides.size(); ++n) {
      const glm::dvec3 normal = glm::cross(sides[n].contact, sides[n + 1 == sides.size() ? 0 : n + 1].contact);
      visit(normal / glm::length(normal));
    }
  }

  // Names each point where three probes meet by the three probes, as arc ends of fixed probes are named by their atoms.
  void join_triples() {
    std::vector<TripleEnd> ends;
    for (std::uint32_t n = 0; n < found_.size(); ++n)
      for (std::uint32_t end = 0; end < 2; ++end) {
        if (found_[n].by[end] == kNone || found_[n].arc.on_axis[end]) continue;
        const auto [s, t] = found_[n].arc.probe;
        const auto [a, b, c, side] = geometry::triple_at(s, t, found_[n].by[end], end != 0);
        ends.push_back({{a, b, c}, side, n * 2 + end});
      }
    std::sort(ends.begin(), ends.end(), [](const TripleEnd& x, const TripleEnd& y) {
      return std::tie(x.probe, x.side, x.arc_and_end) < std::tie(y.probe, y.side, y.arc_and_end);
    });
    for (std::size_t n = 0; n < ends.size();) {
      std::size_t past = n;
      while (past < ends.size() && ends[past].probe == ends[n].probe && ends[past].side == ends[n].side) ++past;
      if (past - n != 3)
        parts_.open_probes.insert(parts_.open_probes.end(), ends[n].probe.begin(), ends[n].probe.end());
      for (std::size_t e = n; e < past; ++e)
        found_[ends[e].arc_and_end / 2].arc.vertex[ends[e].arc_and_end & 1] =
            static_cast<std::uint32_t>(parts_.triple.size());
      parts_.triple.push_back(triple_point(ends[n]));
      n = past;
    }
    parts_.arcs.reserve(found_.size());
    for (const FoundArc& found : found_) parts_.arcs.push_back(found.arc);
    tbb::parallel_for(std::size_t{0}, parts_.arcs.size(), [&](std::size_t n) { refine(parts_.arcs[n]); });
  }

  glm::dvec3 triple_point(const TripleEnd& end) const {
    const glm::dvec3 origin = probes_.position[end.probe[0]];
    const glm::dvec3 b = probes_.position[end.probe[1]] - origin, c = probes_.position[end.probe[2]] - origin;
    double h2 = 0;
    return origin + geometry::probe_of_three(b, c, p_ * p_, p_ * p_, p_ * p_, end.side ? 1.0 : -1.0, h2);
  }

  // Refines an arc: decided with the decision weights, placed with the true radius; start and sweep follow from the end
  // points.
  void refine(CuspArc& arc) const {
    if (arc.vertex[0] == kNone) return;
    const auto direction = [&](int end) {
      const glm::dvec3 point = arc.on_axis[end] ? axis_cusp(toroidal_[arc.vertex[end] / 2], p_, arc.vertex[end] & 1)
                                                : parts_.triple[arc.vertex[end]];
      const glm::dvec3 d = point - arc.center;
      const glm::dvec3 flat = d - arc.axis * glm::dot(d, arc.axis);
      const double length = glm::length(flat);
      return length > 0 ? flat / length : arc.start;
    };
    const double decided = arc.sweep;
    arc.start = direction(0);
    arc.sweep = angle_between(arc.axis, arc.start, direction(1));
    if (decided < 1 && arc.sweep > 5) arc.sweep = 0;
    if (decided > 5 && arc.sweep < 1) arc.sweep = kTwoPi;
  }

  std::span<const Ball> atoms_;
  double p_;
  const FixedProbes& probes_;
  std::span<const ToroidalPatch> toroidal_;
  const ReducedComponents* within_;
  std::vector<std::uint32_t> first_on_circle_;
  CuspProblem problem_;
  std::vector<FoundArc> found_;
  CuspParts parts_;
};

}  // namespace

glm::dvec3 axis_cusp(const ToroidalPatch& patch, double probe_radius, int side) {
  const double along = std::sqrt(std::max(0.0, probe_radius * probe_radius - patch.radius * patch.radius));
  return patch.center + patch.axis * (side ? along : -along);
}

std::vector<std::uint32_t> first_on_circle(std::span<const ToroidalPatch> toroidal, const ReducedComponents* within) {
  std::vector<std::uint32_t> first(toroidal.size());
  std::uint32_t begin = 0;  // range of the patches between these atoms
  for (std::uint32_t t = 0; t < toroidal.size(); ++t) {
    if (toroidal[t].atom != toroidal[begin].atom) begin = t;
    first[t] = begin;
    while (within && within->of_toroidal[first[t]] != within->of_toroidal[t]) ++first[t];
  }
  return first;
}

CuspParts find_cusps(std::span<const Ball> atoms, double probe_radius, const FixedProbes& probes,
                     std::span<const ToroidalPatch> toroidal, CuspTracer& tracer, const ReducedComponents* within) {
  if (probe_radius > 0) return CuspSearch(atoms, probe_radius, probes, toroidal, within).run(tracer);
  CuspParts none;
  none.first_cut.assign(probes.count() + 1, 0);
  return none;
}

}  // namespace meniscus
