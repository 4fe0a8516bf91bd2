// SPDX-License-Identifier: BSD-3-Clause
// Exhaustive enumeration of RS edges, atom by atom in parallel (contour build-up: Totrov & Abagyan 1996).
#include "core/reference/exhaustive.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "core/surface/ball_grid.h"
#include "core/surface/contour.h"

namespace meniscus {
namespace {

// One worker's findings and its reusable lists.
struct Worker {
  std::vector<RsArc> arcs;
  std::vector<std::uint32_t> lone_atoms;
  Blockers blockers;
  Contour contour;
  std::size_t pairs = 0;
};

class Enumeration {
 public:
  Enumeration(std::span<const Ball> atoms, double probe_radius)
      : atoms_(atoms),
        probe_radius_(probe_radius),
        weights_(decision_weights(atoms, probe_radius)),
        swallowed_(swallowed_atoms(atoms, probe_radius)),
        largest_radius_(largest_radius(probe_radius)),
        grid_(atoms, largest_radius_) {}

  ReducedSurface run(EnumerationStats* stats) {
    tbb::enumerable_thread_specific<Worker> workers;
    const auto& order = grid_.order();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, order.size(), 64), [&](const auto& range) {
      Worker& worker = workers.local();
      for (std::size_t n = range.begin(); n != range.end(); ++n)
        if (!swallowed_[order[n]]) visit_atom(order[n], worker);
    });
    ReducedSurface rs;
    for (const Worker& w : workers) {
      rs.arcs.insert(rs.arcs.end(), w.arcs.begin(), w.arcs.end());
      rs.lone_atoms.insert(rs.lone_atoms.end(), w.lone_atoms.begin(), w.lone_atoms.end());
      if (stats) {
        stats->pairs += w.pairs;
        stats->doubtful += w.contour.doubtful_count();
      }
    }
    tbb::parallel_sort(rs.arcs.begin(), rs.arcs.end());
    std::sort(rs.lone_atoms.begin(), rs.lone_atoms.end());
    return rs;
  }

 private:
  double largest_radius(double probe_radius) const {
    double largest = 0;
    for (const Ball& b : atoms_) largest = std::max(largest, b.radius + probe_radius);
    return largest + 2e-9;
  }

  void visit_atom(std::uint32_t i, Worker& w) const {
    list_blockers(i, w.blockers);
    if (w.blockers.size() == 0) {
      w.lone_atoms.push_back(i);
      return;
    }
    for (std::size_t n = 0; n < w.blockers.size(); ++n) {
      const std::uint32_t j = w.blockers[n].label;
      if (j < i) continue;
      ++w.pairs;
      w.contour.expose(w.blockers[n].center, weights_[j], w.blockers, n);
      if (w.contour.whole()) w.arcs.push_back({i, j, kNone, kNone});
      for (const ExposedArc& arc : w.contour.arcs()) w.arcs.push_back({i, j, arc.begin_by, arc.end_by});
    }
  }

  // The balls that overlap ball i.
  void list_blockers(std::uint32_t i, Blockers& blockers) const {
    blockers.restart(weights_[i]);
    const double radius = std::sqrt(weights_[i]);
    grid_.for_each_near(atoms_[i].center, radius + largest_radius_, [&](std::uint32_t j) {
      if (j == i || swallowed_[j]) return;
      const glm::dvec3 d = atoms_[j].center - atoms_[i].center;
      const double reach = radius + atoms_[j].radius + probe_radius_ + 2e-9;  // not below the sum of the grown radii
      if (glm::dot(d, d) < reach * reach) blockers.add(d, weights_[j], j);
    });
    blockers.sort();
  }

  std::span<const Ball> atoms_;
  double probe_radius_;
  std::vector<double> weights_;
  std::vector<bool> swallowed_;
  double largest_radius_;
  BallGrid grid_;
};

}  // namespace

ReducedSurface enumerate_reduced_surface(std::span<const Ball> atoms, double probe_radius, EnumerationStats* stats) {
  return Enumeration(atoms, probe_radius).run(stats);
}

}  // namespace meniscus
