// SPDX-License-Identifier: BSD-3-Clause
// Exhaustive enumeration of RS edges, atom by atom in parallel (contour build-up: Totrov & Abagyan 1996).
#include "core/reduced_surface/cpu/exhaustive.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "core/math/ball_grid.h"
#include "core/reduced_surface/contour/contour.h"
#include "core/reduced_surface/contour/sphere_cover.h"

namespace meniscus {
namespace {

// One worker's findings and its reusable lists.
struct Worker {
  std::vector<RsArc> arcs;
  std::vector<std::uint32_t> lone_atoms;
  std::vector<std::pair<double, std::uint32_t>> near;  // squared distance, atom
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
        swallowed_(swallowed_atoms(atoms)),
        largest_radius_(largest_radius(probe_radius)),
        grid_(atoms, largest_radius_),
        neighbors_(atoms.size()),
        uncovered_(atoms.size()) {}

  ReducedSurface run(CircleStats* stats) {
    tbb::enumerable_thread_specific<Worker> workers;
    const auto for_each_atom = [&](auto&& visit) {
      const auto& order = grid_.order();
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, order.size(), 64), [&](const auto& range) {
        Worker& worker = workers.local();
        for (std::size_t n = range.begin(); n != range.end(); ++n)
          if (!swallowed_[order[n]]) visit(order[n], worker);
      });
    };
    // Nearly half of all atoms are buried, which is quickly told; their circles need no look.
    for_each_atom([&](std::uint32_t i, Worker& worker) {
      find_neighbors(i, worker);
      list_blockers(i, worker.blockers);
      uncovered_[i] = uncovered_directions(worker.blockers);
      if (uncovered_[i].none()) neighbors_[i] = {};
    });
    for_each_atom([&](std::uint32_t i, Worker& worker) { visit_atom(i, worker); });
    ReducedSurface rs;
    for (const Worker& w : workers) {
      rs.arcs.insert(rs.arcs.end(), w.arcs.begin(), w.arcs.end());
      rs.lone_atoms.insert(rs.lone_atoms.end(), w.lone_atoms.begin(), w.lone_atoms.end());
      if (stats) {
        stats->pairs += w.pairs;
        stats->decided_in_quadruple += w.contour.doubtful_count();
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
    if (uncovered_[i].none()) return;
    list_blockers(i, w.blockers);
    if (w.blockers.size() == 0) {
      w.lone_atoms.push_back(i);
      return;
    }
    for (std::size_t n = 0; n < w.blockers.size(); ++n) {
      const std::uint32_t j = w.blockers[n].label;
      if (j < i) continue;
      if (surely_covered(i, w.blockers[n])) continue;
      w.contour.expose(w.blockers[n].center, weights_[j], w.blockers, n);
      if (w.contour.whole()) w.arcs.push_back({i, j, kNone, kNone});
      for (const ExposedArc& arc : w.contour.arcs()) w.arcs.push_back({i, j, arc.begin_by, arc.end_by});
    }
  }

  // Seen from either atom, the circle must pass near a direction that is not surely covered.
  bool surely_covered(std::uint32_t i, const Blockers::Ball& b) const {
    if (uncovered_[b.label].none()) return true;
    if (!(b.distance > 1e-6)) return false;
    const double height = b.half_power / b.distance, ri = std::sqrt(weights_[i]), rj = std::sqrt(b.weight);
    const glm::dvec3 axis = b.center / b.distance;
    return !may_be_exposed(uncovered_[i], axis, height / ri) ||
           !may_be_exposed(uncovered_[b.label], -axis, (b.distance - height) / rj);
  }

  // The balls that overlap ball i, nearest first: near balls cover most, and a covered circle is done with.
  void find_neighbors(std::uint32_t i, Worker& w) {
    w.near.clear();
    const double radius = std::sqrt(weights_[i]);
    grid_.for_each_near(atoms_[i].center, radius + largest_radius_, [&](std::uint32_t j) {
      if (j == i || swallowed_[j]) return;
      const glm::dvec3 d = atoms_[j].center - atoms_[i].center;
      const double square = glm::dot(d, d);
      const double reach = radius + atoms_[j].radius + probe_radius_ + 2e-9;  // not below the sum of the grown radii
      if (square < reach * reach) w.near.emplace_back(square, j);
    });
    std::sort(w.near.begin(), w.near.end());
    neighbors_[i].reserve(w.near.size());
    for (const auto& [square, j] : w.near) {
      neighbors_[i].push_back(j);
      w.pairs += j > i;
    }
  }

  void list_blockers(std::uint32_t i, Blockers& blockers) const {
    blockers.restart(weights_[i]);
    for (const std::uint32_t j : neighbors_[i]) blockers.add(atoms_[j].center - atoms_[i].center, weights_[j], j);
  }

  std::span<const Ball> atoms_;
  double probe_radius_;
  std::vector<double> weights_;
  std::vector<bool> swallowed_;
  double largest_radius_;
  BallGrid grid_;
  std::vector<std::vector<std::uint32_t>> neighbors_;  // empty for buried atoms once that is known
  std::vector<UncoveredDirections> uncovered_;
};

}  // namespace

ReducedSurface enumerate_reduced_surface(std::span<const Ball> atoms, double probe_radius, CircleStats* stats) {
  return Enumeration(atoms, probe_radius).run(stats);
}

}  // namespace meniscus
