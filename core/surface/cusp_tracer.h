// SPDX-License-Identifier: BSD-3-Clause
// The two questions about singularities that run in parallel: which probe cuts which, and which arcs remain.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/gpu/kernel_records.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// One side of a concave patch as the search for cusps sees it.
struct CuspSide {
  glm::dvec3 contact{0.0};        ///< unit vector from the probe to the side's first contact
  std::uint32_t circle = kNone;   ///< names the spindle circle the side belongs to; kNone if it is not a spindle
  bool touching = false;          ///< the circle is exactly as large as the probe: its two cusps are one point
  std::uint32_t partner = kNone;  ///< the probe across the covered gap of that circle
  std::uint32_t apart = kNone;    ///< the probe at the other end of the side's arc, if neither can cut the other
  glm::dvec3 gap_direction{0.0};  ///< from the circle's centre to the middle of that gap, unit length
  glm::dvec3 circle_center{0.0};
};

/// All fixed probes, ready to be cut. Sides of probe s: sides[first_side[s]] to sides[first_side[s + 1] - 1].
struct CuspProblem {
  double probe_radius = 0.0;
  std::span<const glm::dvec3> positions;
  std::span<const double> heights;  ///< over the contacts; only probes lower than their radius are cut (theorem 1.3)
  std::span<const std::uint32_t> first_side;
  std::vector<CuspSide> sides;
  std::vector<double> weights;  ///< decision weights

  std::uint32_t count() const { return static_cast<std::uint32_t>(positions.size()); }
  bool low(std::uint32_t s) const { return heights[s] < probe_radius; }
  std::span<const CuspSide> sides_of(std::uint32_t s) const {
    return {sides.data() + first_side[s], sides.data() + first_side[s + 1]};
  }
};

/// Lists of probes by probe, each ascending: those of s are probe[first[s]] to probe[first[s + 1] - 1].
struct CutLists {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> probe;
  std::span<const std::uint32_t> of(std::uint32_t s) const {
    return {probe.data() + first[s], probe.data() + first[s + 1]};
  }
};

/// Arc ends are named by the probe that covers the circle beyond, or, with this bit, by the side (of the lower probe)
/// whose spindle axis ends it.
using kernel::kAxisLabel;
static_assert(kNone == kernel::kNone);

/// What is left of the circle of two probes among all others: from `begin` to `end` (unit vectors from its centre),
/// counter-clockwise about the axis from the lower probe to the higher; `by` kNone twice: all of it.
struct TracedArc {
  std::array<std::uint32_t, 2> probe{};  ///< ascending
  std::array<std::uint32_t, 2> by{kNone, kNone};
  glm::dvec3 begin{0.0};
  glm::dvec3 end{0.0};
};

/// Answers both questions on some device.
class CuspTracer {
 public:
  virtual ~CuspTracer() = default;

  /// For each low probe all probes whose bisector reaches into its spherical polygon.
  virtual CutLists list_cuts(const CuspProblem& problem) = 0;

  /// The exposed arcs of the circles of all pairs that cut each other, in any order.
  virtual std::vector<TracedArc> trace(const CuspProblem& problem, const CutLists& cuts) = 0;
};

/// On the CPU, in double and quadruple precision, on all cores.
std::unique_ptr<CuspTracer> make_cpu_cusp_tracer();

/// Whether the ball of a probe at `other` reaches into the spherical polygon of probe s.
bool reaches(const CuspProblem& problem, std::uint32_t s, const glm::dvec3& other);

/// What is known without arithmetic, and what arithmetic cannot tell when two probes nearly coincide: partners on a
/// spindle circle always cut each other, for both patches end in its axis cusps; and the ends of an arc of at most half
/// a turn on a circle as large as the probe never do, for what is nearer to the other lies past the axis.
void settle_neighbors(const CuspProblem& problem, CutLists& cuts);

/// Pairs s < t that are in each other's lists.
std::vector<std::array<std::uint32_t, 2>> mutual_pairs(const CutLists& cuts);

class Blockers;

/// Traces pairs on the host: `near` holds all probes closer than 2p to s, relative to it. Appends to `found`. Only
/// probes that cut both patches can cover the circle where it lies on both; whatever others do is beside them.
class PairTracer {
 public:
  PairTracer(const CuspProblem& problem, const CutLists& cuts);
  ~PairTracer();
  PairTracer(PairTracer&&) noexcept;

  void trace(std::uint32_t s, std::uint32_t t, const Blockers& near, std::vector<TracedArc>& found);

 private:
  struct Scratch;
  bool set_halves(std::uint32_t s, std::uint32_t t);
  void list_others(std::uint32_t s, std::uint32_t t, const Blockers& near);

  const CuspProblem* problem_;
  const CutLists* cuts_;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace meniscus
