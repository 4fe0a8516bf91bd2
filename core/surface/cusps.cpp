// SPDX-License-Identifier: BSD-3-Clause
// Cusp curves by contour build-up among fixed probes, with the pencils of spindle circles decided by their order.
#include "core/surface/cusps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/surface/ball_grid.h"
#include "core/surface/contour.h"
#include "core/surface/reduced_surface.h"

namespace meniscus {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

// Labels of contour arcs are probes, or (with the top bit) the axis of a spindle circle that both probes stand on.
constexpr std::uint32_t kAxisLabel = 0x80000000u;

// Across the covered gap beside a side of a spindle circle: the next fixed probe, and the direction half-way.
struct Gap {
  std::uint32_t partner = kNone;
  glm::dvec3 direction{0.0};
};

// A spindle circle that two probes stand on, as neighbours across a covered gap.
struct Pencil {
  std::uint32_t first_patch;  // names the circle
  glm::dvec3 direction;       // the half-plane of the bisector that is not past the axis
};

struct FoundArc {
  CuspArc arc;
  std::array<std::uint32_t, 2> by{kNone, kNone};
};

// The end of a cusp arc where three probes meet.
struct TripleEnd {
  std::array<std::uint32_t, 3> probe;
  std::uint32_t side;
  std::uint32_t arc_and_end;
};

struct Worker {
  std::vector<Blocker> blockers;
  std::vector<Blocker> others;
  std::vector<BlockedHalf> halves;
  std::vector<Pencil> pencils;
  Contour contour;
  std::vector<FoundArc> found;
};

double angle_between(const glm::dvec3& axis, const glm::dvec3& a, const glm::dvec3& b) {
  const double angle = std::atan2(glm::dot(axis, glm::cross(a, b)), glm::dot(a, b));
  return angle < 0 ? angle + kTwoPi : angle;
}

class CuspSearch {
 public:
  CuspSearch(std::span<const Ball> atoms, double probe_radius, const FixedProbes& probes,
             std::span<const ToroidalPatch> toroidal)
      : atoms_(atoms),
        p_(probe_radius),
        probes_(probes),
        toroidal_(toroidal),
        first_on_circle_(first_on_circle(toroidal)),
        grid_(std::span<const glm::dvec3>(probes.position), 2 * probe_radius),
        weights_(probes.count()) {
    for (std::size_t s = 0; s < weights_.size(); ++s) weights_[s] = decision_weight(p_, s);
  }

  CuspParts run() {
    find_contact_directions();
    find_gaps();
    list_cuts();
    trace_pairs();
    join_triples();
    return std::move(parts_);
  }

 private:
  // All probes on such a circle pass through the same two points of its axis, or one when it is as large as the probe.
  bool pencil(const ToroidalPatch& t) const { return touches_axis(t, atoms_, p_); }
  bool low(std::uint32_t s) const { return probes_.height[s] < p_; }
  std::uint32_t circle_of(const ProbeSide& side) const { return first_on_circle_[side.toroidal]; }

  void find_contact_directions() {
    directions_.resize(probes_.sides.size());
    tbb::parallel_for(std::size_t{0}, probes_.count(), [&](std::size_t s) {
      for (std::uint32_t n = probes_.first_side[s]; n < probes_.first_side[s + 1]; ++n)
        directions_[n] = glm::normalize(atoms_[probes_.sides[n].from].center - probes_.position[s]);
    });
  }

  // For each end of an arc of a spindle circle: which probe ends the covered gap beyond it?
  void find_gaps() {
    std::vector<std::array<std::uint32_t, 2>> side_at(toroidal_.size());  // patch, end -> side
    for (std::uint32_t n = 0; n < probes_.sides.size(); ++n)
      side_at[probes_.sides[n].toroidal][probes_.sides[n].at_end] = n;
    gaps_.assign(probes_.sides.size(), {});
    std::vector<std::pair<double, std::uint32_t>> around;
    for (std::uint32_t first = 0, past = 0; first < toroidal_.size(); first = past) {
      for (past = first + 1; past < toroidal_.size() && first_on_circle_[past] == first; ++past) {
      }
      const ToroidalPatch& lead = toroidal_[first];
      if (lead.free() || !pencil(lead)) continue;
      around.clear();
      for (std::uint32_t t = first; t < past; ++t)
        around.emplace_back(t == first ? 0.0 : angle_between(lead.axis, lead.start, toroidal_[t].start), t);
      std::sort(around.begin(), around.end());
      for (std::size_t n = 0; n < around.size(); ++n) {
        const std::uint32_t t = around[n].second, u = around[(n + 1) % around.size()].second;
        const double begin = around[n].first + toroidal_[t].sweep;
        const double end = around[(n + 1) % around.size()].first + (n + 1 == around.size() ? kTwoPi : 0.0);
        const double middle = 0.5 * (begin + end);
        const glm::dvec3 direction =
            std::cos(middle) * lead.start + std::sin(middle) * glm::cross(lead.axis, lead.start);
        gaps_[side_at[t][1]] = {toroidal_[u].probe[0], direction};
        gaps_[side_at[u][0]] = {toroidal_[t].probe[1], direction};
      }
    }
  }

  // Largest dot product of the unit vector d with the points of the probe's spherical polygon.
  double reach(std::uint32_t s, const glm::dvec3& d) const {
    const std::uint32_t first = probes_.first_side[s], past = probes_.first_side[s + 1];
    double best = -1;
    bool inside = true;
    for (std::uint32_t n = first; n < past; ++n) {
      const glm::dvec3 &a = directions_[n], &b = directions_[n + 1 == past ? first : n + 1];
      const glm::dvec3 normal = glm::cross(a, b);
      const double outside = glm::dot(normal, d);
      best = std::max(best, glm::dot(d, a));
      if (outside <= 0) continue;
      inside = false;
      if (glm::dot(glm::cross(normal, a), d) > 0 && glm::dot(glm::cross(b, normal), d) > 0)
        best = std::max(best, std::sqrt(std::max(0.0, 1 - outside * outside / glm::dot(normal, normal))));
    }
    return inside ? 1.0 : best;
  }

  // Every probe whose bisector reaches into the polygon of s; high probes are never cut (theorem 1.3).
  void list_cuts() {
    std::vector<std::vector<std::uint32_t>> cuts(probes_.count());
    tbb::parallel_for(std::size_t{0}, probes_.count(), [&](std::size_t n) {
      const auto s = static_cast<std::uint32_t>(n);
      if (!low(s)) return;
      grid_.for_each_near(probes_.position[s], 2 * p_, [&](std::uint32_t t) {
        if (t == s) return;
        const glm::dvec3 d = probes_.position[t] - probes_.position[s];
        const double distance = glm::length(d);
        if (distance > 0 && reach(s, d / distance) * 2 * p_ >= distance * (1 - 1e-12)) cuts[s].push_back(t);
      });
      std::sort(cuts[s].begin(), cuts[s].end());
    });
    parts_.first_cut.assign(probes_.count() + 1, 0);
    for (std::size_t s = 0; s < probes_.count(); ++s) {
      parts_.cuts.insert(parts_.cuts.end(), cuts[s].begin(), cuts[s].end());
      parts_.first_cut[s + 1] = static_cast<std::uint32_t>(parts_.cuts.size());
    }
  }

  std::span<const std::uint32_t> cuts_of(std::uint32_t s) const {
    return {parts_.cuts.data() + parts_.first_cut[s], parts_.cuts.data() + parts_.first_cut[s + 1]};
  }

  void trace_pairs() {
    tbb::enumerable_thread_specific<Worker> workers;
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(probes_.count()), 32),
                      [&](const auto& range) {
                        Worker& w = workers.local();
                        for (std::uint32_t s = range.begin(); s != range.end(); ++s) trace_probe(s, w);
                      });
    for (const Worker& w : workers) found_.insert(found_.end(), w.found.begin(), w.found.end());
    std::sort(found_.begin(), found_.end(), [](const FoundArc& a, const FoundArc& b) {
      return std::tie(a.arc.probe, a.by) < std::tie(b.arc.probe, b.by);
    });
  }

  void trace_probe(std::uint32_t s, Worker& w) const {
    w.blockers.clear();
    for (std::uint32_t t : cuts_of(s)) {
      if (t < s) continue;
      const auto back = cuts_of(t);
      if (!std::binary_search(back.begin(), back.end(), s)) continue;
      if (w.blockers.empty()) list_blockers(s, w);
      trace_pair(s, t, w);
    }
  }

  void list_blockers(std::uint32_t s, Worker& w) const {
    grid_.for_each_near(probes_.position[s], 2 * p_ + 4e-9, [&](std::uint32_t u) {
      if (u != s) w.blockers.push_back({probes_.position[u] - probes_.position[s], weights_[u], u});
    });
    std::sort(w.blockers.begin(), w.blockers.end(), [](const Blocker& a, const Blocker& b) {
      const double aa = glm::dot(a.center, a.center), bb = glm::dot(b.center, b.center);
      return aa < bb || (aa == bb && a.label < b.label);
    });
  }

  void trace_pair(std::uint32_t s, std::uint32_t t, Worker& w) const {
    if (!find_pencils(s, t, w)) return;
    w.others.clear();
    for (const Blocker& b : w.blockers)
      if (b.label != t && !on_pencil(b.label, w)) w.others.push_back(b);
    const glm::dvec3 d = probes_.position[t] - probes_.position[s];
    if (!set_halves(s, d, w)) return;
    w.contour.expose(d, weights_[s], weights_[t], w.others, w.others.size(), w.halves);

    const geometry::Circle& circle = w.contour.circle();
    FoundArc found;
    found.arc.probe = {s, t};
    found.arc.axis = glm::normalize(d);
    found.arc.center = probes_.position[s] + 0.5 * d;
    found.arc.radius = std::sqrt(std::max(0.0, p_ * p_ - 0.25 * glm::dot(d, d)));
    const auto direction = [&](const glm::dvec2& e) { return e.x * circle.u + e.y * circle.v; };
    if (w.contour.whole()) {
      found.arc.start = circle.u;
      found.arc.sweep = kTwoPi;
      if (on_both_patches(found.arc)) w.found.push_back(found);
      return;
    }
    for (const ExposedArc& arc : w.contour.arcs()) {
      found.arc.start = direction(arc.begin);
      found.arc.sweep = angle_between(circle.axis, found.arc.start, direction(arc.end));
      found.by = {arc.begin_by, arc.end_by};
      if (!on_both_patches(found.arc)) continue;
      FoundArc named = found;
      for (int end = 0; end < 2; ++end)
        if (named.by[end] & kAxisLabel) name_axis_cusp(named, end, end ? direction(arc.end) : direction(arc.begin), w);
      w.found.push_back(named);
    }
  }

  // The spindle circles that s and t share. False if on one of them they are not neighbours across a covered gap:
  // then other probes of the circle are nearer everywhere on the bisector.
  bool find_pencils(std::uint32_t s, std::uint32_t t, Worker& w) const {
    w.pencils.clear();
    for (std::uint32_t n = probes_.first_side[s]; n < probes_.first_side[s + 1]; ++n) {
      if (!pencil(toroidal_[probes_.sides[n].toroidal])) continue;
      const std::uint32_t circle = circle_of(probes_.sides[n]);
      for (const ProbeSide& other : probes_.sides_of(t)) {
        if (circle_of(other) != circle) continue;
        if (gaps_[n].partner != t) return false;
        w.pencils.push_back({circle, gaps_[n].direction});
      }
    }
    return true;
  }

  bool on_pencil(std::uint32_t u, const Worker& w) const {
    for (const Pencil& pencil : w.pencils)
      for (const ProbeSide& side : probes_.sides_of(u))
        if (circle_of(side) == pencil.first_patch) return true;
    return false;
  }

  // Past the axis of a shared spindle circle nothing of the pair's circle is left. False if that is all of it.
  bool set_halves(std::uint32_t s, const glm::dvec3& d, Worker& w) const {
    w.halves.clear();
    if (w.pencils.empty()) return true;
    const geometry::Circle circle = geometry::circle_of_two_spheres(d, weights_[s], weights_[s]);
    const glm::dvec3 center = probes_.position[s] + 0.5 * d;
    for (std::uint32_t n = 0; n < w.pencils.size(); ++n) {
      const Pencil& pencil = w.pencils[n];
      BlockedHalf half;
      half.label = kAxisLabel | n;
      half.half_plane.normal = {-glm::dot(circle.u, pencil.direction), -glm::dot(circle.v, pencil.direction)};
      half.half_plane.offset =
          glm::dot(pencil.direction, center - toroidal_[pencil.first_patch].center) / circle.radius;
      half.half_plane.length_squared = glm::dot(half.half_plane.normal, half.half_plane.normal);
      half.half_plane.error = 1e-14;
      // As large as the probe: the pair's circle touches the axis, so it lies before it or past it as a whole.
      const bool touching = toroidal_[pencil.first_patch].radius == p_;
      const double gap = half.half_plane.length_squared - half.half_plane.offset * half.half_plane.offset;
      if (gap > 0 && !touching)
        w.halves.push_back(half);
      else if (half.half_plane.offset < 0)
        return false;
    }
    return true;
  }

  void name_axis_cusp(FoundArc& found, int end, const glm::dvec3& direction, const Worker& w) const {
    const std::uint32_t first = w.pencils[found.by[end] & ~kAxisLabel].first_patch;
    const glm::dvec3 point = found.arc.center + found.arc.radius * direction;
    const bool upper = glm::dot(toroidal_[first].axis, point - toroidal_[first].center) > 0;
    found.arc.on_axis[end] = true;
    found.arc.vertex[end] = first * 2 + (upper ? 1 : 0);
  }

  // A piece of the circle lies on both patches or on neither, so one point of it decides; near a border the point and
  // the patch with the larger margin have the say.
  bool on_both_patches(const CuspArc& arc) const {
    double clearest = 0;
    for (const double part : {0.5, 0.3, 0.7}) {
      const double angle = part * arc.sweep;
      const glm::dvec3 e = std::cos(angle) * arc.start + std::sin(angle) * glm::cross(arc.axis, arc.start);
      for (const std::uint32_t s : arc.probe)
        if (const double depth = depth_in_cone(s, arc.center + arc.radius * e); std::abs(depth) > std::abs(clearest))
          clearest = depth;
    }
    return clearest > 0;
  }

  double depth_in_cone(std::uint32_t s, const glm::dvec3& point) const {
    const std::uint32_t first = probes_.first_side[s], past = probes_.first_side[s + 1];
    double depth = 1e300;
    for (std::uint32_t n = first; n < past; ++n) {
      const glm::dvec3 normal = glm::cross(directions_[n], directions_[n + 1 == past ? first : n + 1]);
      depth = std::min(depth, -glm::dot(normal, point - probes_.position[s]) / glm::length(normal));
    }
    return depth;
  }

  // Names the points where three probes meet by the three, as arc ends of fixed probes are named by their atoms.
  void join_triples() {
    std::vector<TripleEnd> ends;
    for (std::uint32_t n = 0; n < found_.size(); ++n)
      for (std::uint32_t end = 0; end < 2; ++end) {
        if (found_[n].by[end] == kNone || found_[n].arc.on_axis[end]) continue;
        std::uint32_t a = found_[n].arc.probe[0], b = found_[n].arc.probe[1], c = found_[n].by[end];
        std::uint32_t side = end ? 0 : 1;
        if (c < a) {
          std::swap(b, c);
          std::swap(a, b);
        } else if (c < b) {
          std::swap(b, c);
          side ^= 1;
        }
        ends.push_back({{a, b, c}, side, n * 2 + end});
      }
    std::sort(ends.begin(), ends.end(), [](const TripleEnd& x, const TripleEnd& y) {
      return std::tie(x.probe, x.side, x.arc_and_end) < std::tie(y.probe, y.side, y.arc_and_end);
    });
    for (std::size_t n = 0; n < ends.size();) {
      std::size_t past = n;
      while (past < ends.size() && ends[past].probe == ends[n].probe && ends[past].side == ends[n].side) ++past;
      if (past - n != 3) parts_.open_probes.insert(parts_.open_probes.end(), ends[n].probe.begin(), ends[n].probe.end());
      for (std::size_t e = n; e < past; ++e)
        found_[ends[e].arc_and_end / 2].arc.vertex[ends[e].arc_and_end & 1] =
            static_cast<std::uint32_t>(parts_.triple.size());
      parts_.triple.push_back(triple_point(ends[n]));
      n = past;
    }
    parts_.arcs.reserve(found_.size());
    for (FoundArc& found : found_) {
      refine(found.arc);
      parts_.arcs.push_back(found.arc);
    }
  }

  glm::dvec3 triple_point(const TripleEnd& end) const {
    const glm::dvec3 origin = probes_.position[end.probe[0]];
    const glm::dvec3 b = probes_.position[end.probe[1]] - origin, c = probes_.position[end.probe[2]] - origin;
    double h2 = 0;
    return origin + geometry::probe_of_three(b, c, p_ * p_, p_ * p_, p_ * p_, end.side ? 1.0 : -1.0, h2);
  }

  // Decided with the decision weights, placed with the true radius: start and sweep follow the end points.
  void refine(CuspArc& arc) const {
    if (arc.vertex[0] == kNone) return;
    const auto direction = [&](int end) {
      const glm::dvec3 point = arc.on_axis[end]
                                   ? axis_cusp(toroidal_[arc.vertex[end] / 2], p_, arc.vertex[end] & 1)
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
  std::vector<std::uint32_t> first_on_circle_;
  BallGrid grid_;
  std::vector<double> weights_;
  std::vector<glm::dvec3> directions_;  // per side: from the probe to the side's first contact
  std::vector<Gap> gaps_;               // per side
  std::vector<FoundArc> found_;
  CuspParts parts_;
};

}  // namespace

glm::dvec3 axis_cusp(const ToroidalPatch& patch, double probe_radius, int side) {
  const double along = std::sqrt(std::max(0.0, probe_radius * probe_radius - patch.radius * patch.radius));
  return patch.center + patch.axis * (side ? along : -along);
}

std::vector<std::uint32_t> first_on_circle(std::span<const ToroidalPatch> toroidal) {
  std::vector<std::uint32_t> first(toroidal.size());
  for (std::uint32_t t = 0; t < toroidal.size(); ++t)
    first[t] = t > 0 && toroidal[t].atom == toroidal[t - 1].atom ? first[t - 1] : t;
  return first;
}

CuspParts find_cusps(std::span<const Ball> atoms, double probe_radius, const FixedProbes& probes,
                     std::span<const ToroidalPatch> toroidal) {
  if (probe_radius > 0) return CuspSearch(atoms, probe_radius, probes, toroidal).run();
  CuspParts none;
  none.first_cut.assign(probes.count() + 1, 0);
  return none;
}

}  // namespace meniscus
