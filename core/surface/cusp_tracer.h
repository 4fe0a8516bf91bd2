// SPDX-License-Identifier: BSD-3-Clause
// The two parallel steps in the search for singularities: which probe cuts which, and which arcs remain.
#pragma once

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
  glm::dvec3 gap_direction{0.0};  ///< unit vector from the circle's centre to the middle of that gap
  glm::dvec3 circle_center{0.0};
};

/// All fixed probes in the form that the search needs. The sides of probe s are sides[first_side[s]] to
/// sides[first_side[s + 1] - 1].
struct CuspProblem {
  double probe_radius = 0.0;              ///< Å
  std::span<const glm::dvec3> positions;  ///< centres of the probes, Å
  std::span<const double>
      heights;  ///< height over the contacts; only probes lower than their radius are cut (theorem 1.3)
  std::span<const std::uint32_t> first_side;
  std::vector<CuspSide> sides;
  std::vector<double> weights;  ///< decision weights

  std::uint32_t count() const { return static_cast<std::uint32_t>(positions.size()); }
  bool low(std::uint32_t s) const { return heights[s] < probe_radius; }
  std::span<const CuspSide> sides_of(std::uint32_t s) const {
    return {sides.data() + first_side[s], sides.data() + first_side[s + 1]};
  }
};

/// Lists of probes per probe, each ascending: the list of s is probe[first[s]] to probe[first[s + 1] - 1].
struct CutLists {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> probe;
  std::span<const std::uint32_t> of(std::uint32_t s) const {
    return {probe.data() + first[s], probe.data() + first[s + 1]};
  }
};

/// The bit that marks an arc end on an axis. An arc end is named by the probe that covers the circle beyond it, or,
/// with this bit, by the side of the lower probe whose spindle axis ends the arc.
using kernel::kAxisLabel;
static_assert(kNone == kernel::kNone);

/// The part of the circle of two probes that no other probe covers: from `begin` to `end` (unit vectors from its
/// centre), counter-clockwise about the axis from the lower to the higher probe. `by` is kNone twice for the whole
/// circle.
struct TracedArc {
  std::array<std::uint32_t, 2> probe{};  ///< ascending
  std::array<std::uint32_t, 2> by{kNone, kNone};
  glm::dvec3 begin{0.0};
  glm::dvec3 end{0.0};
};

/// Carries out both steps on some device.
class CuspTracer {
 public:
  virtual ~CuspTracer() = default;

  /// Lists, for each low probe, all probes whose bisector reaches into its spherical polygon.
  virtual CutLists list_cuts(const CuspProblem& problem) = 0;

  /// Returns the exposed arcs of the circles of all pairs that cut each other, in any order.
  virtual std::vector<TracedArc> trace(const CuspProblem& problem, const CutLists& cuts) = 0;
};

/// Makes a tracer that runs on all cores of the CPU, in double and quadruple precision.
std::unique_ptr<CuspTracer> make_cpu_cusp_tracer();

/// True if the ball of a probe at `other` reaches into the spherical polygon of probe s.
bool reaches(const CuspProblem& problem, std::uint32_t s, const glm::dvec3& other);

/// Corrects the lists where the answer is known without arithmetic, and where arithmetic cannot decide because two
/// probes nearly coincide. Partners on a spindle circle always cut each other, because both patches end in its axis
/// cusps. The probes at the ends of an arc of at most half a turn, on a circle as large as the probe, never cut each
/// other, because every point nearer to the other probe lies past the axis.
void correct_neighbors(const CuspProblem& problem, CutLists& cuts);

/// Returns true if each of two probes is in the other's list, given that t is in the list of s.
bool are_mutual(const CutLists& cuts, std::uint32_t s, std::uint32_t t);

/// Returns the pairs s < t in which each probe is in the other's list.
std::vector<std::array<std::uint32_t, 2>> mutual_pairs(const CutLists& cuts);

class Blockers;

/// Traces pairs on the host. `near` holds all probes closer than 2p to s, relative to it. Appends to `found`. Only
/// probes that cut both patches can cover the circle where it lies on both patches; other probes do not matter.
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
