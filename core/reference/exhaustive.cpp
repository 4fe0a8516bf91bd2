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

struct Neighbor {
  double distance_squared;
  std::uint32_t atom;
};

// One worker's findings and its reusable lists.
struct Worker {
  std::vector<RsArc> arcs;
  std::vector<std::uint32_t> lone_atoms;
  std::vector<Neighbor> neighbors;
  std::vector<Blocker> blockers;
  Contour contour;
  std::size_t pairs = 0;
};

class Enumeration {
 public:
  Enumeration(std::span<const Ball> atoms, double probe_radius)
      : atoms_(atoms),
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
    list_blockers(i, w);
    if (w.blockers.empty()) {
      w.lone_atoms.push_back(i);
      return;
    }
    for (std::size_t n = 0; n < w.blockers.size(); ++n) {
      const std::uint32_t j = w.blockers[n].label;
      if (j < i) continue;
      ++w.pairs;
      w.contour.expose(w.blockers[n].center, weights_[i], weights_[j], w.blockers, n);
      if (w.contour.whole()) w.arcs.push_back({i, j, kNone, kNone});
      for (const ExposedArc& arc : w.contour.arcs()) w.arcs.push_back({i, j, arc.begin_by, arc.end_by});
    }
  }

  // The balls that overlap ball i, nearest first: near ones cover most, and a covered circle is done with.
  void list_blockers(std::uint32_t i, Worker& w) const {
    w.neighbors.clear();
    w.blockers.clear();
    const double radius = std::sqrt(weights_[i]);
    grid_.for_each_near(atoms_[i].center, radius + largest_radius_, [&](std::uint32_t j) {
      if (j == i || swallowed_[j]) return;
      const glm::dvec3 d = atoms_[j].center - atoms_[i].center;
      const double dd = glm::dot(d, d);
      const double reach = radius + std::sqrt(weights_[j]) + 1e-12;
      if (dd < reach * reach) w.neighbors.push_back({dd, j});
    });
    std::sort(w.neighbors.begin(), w.neighbors.end(), [](const Neighbor& a, const Neighbor& b) {
      return a.distance_squared < b.distance_squared || (a.distance_squared == b.distance_squared && a.atom < b.atom);
    });
    for (const Neighbor& n : w.neighbors)
      w.blockers.push_back({atoms_[n.atom].center - atoms_[i].center, weights_[n.atom], n.atom});
  }

  std::span<const Ball> atoms_;
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
