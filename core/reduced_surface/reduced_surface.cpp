// SPDX-License-Identifier: BSD-3-Clause
// Computes decision weights and finds swallowed atoms: two conventions that all ways to the reduced surface share.
#include "core/reduced_surface/reduced_surface.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/math/ball_grid.h"
#include "core/math/geometry.h"

namespace meniscus {
namespace {

// Atoms this little larger than the one that holds them count as inside: as near as two probe positions count as one.
// The circle of two spheres nearer than this would be as blurred as their difference.
const double kSwallowTolerance = geometry::kMergeDistance;

// Of two balls that nearly coincide the larger one stays; of equal ones that of the lower index.
bool outranks(std::span<const Ball> atoms, std::uint32_t a, std::uint32_t b) {
  return atoms[a].radius != atoms[b].radius ? atoms[a].radius > atoms[b].radius : a < b;
}

constexpr double kWay = 0.7;  // Å, that an atom may go; both may come, so that bonded atoms are pairs, and few others

// Å, of decision weights.
double growth(std::size_t index) { return 1e-9 * (1.0 + 0.5 * scattered(index)); }

struct Holder {
  std::uint32_t held, by;
  double slack;  // Å between the spheres where they are nearest; negative: the held one sticks out
};

/// An atom that holds another has a centre closer than the largest radius difference.
double farthest_holder(std::span<const Ball> atoms) {
  const auto [smallest, largest] =
      std::minmax_element(atoms.begin(), atoms.end(), [](auto& a, auto& b) { return a.radius < b.radius; });
  return largest->radius - smallest->radius + kSwallowTolerance;
}

/// Calls visit(a, b), a < b, once for each pair of centres within `reach`, on all threads. Cell by cell, for the cache.
template <typename Visit>
void for_each_pair_near(std::span<const Ball> atoms, double reach, const Visit& visit) {
  const BallGrid grid(atoms, std::max(reach, 2.0));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, atoms.size(), 256), [&](const auto& range) {
    for (std::size_t n = range.begin(); n != range.end(); ++n) {
      const std::uint32_t a = grid.order()[n];
      grid.for_each_near(atoms[a].center, reach, [&](std::uint32_t b) {
        if (a < b) visit(a, b);
      });
    }
  });
}

/// If the higher of two could swallow the other, but for others who swallow it.
void add_holder(std::span<const Ball> atoms, std::uint32_t a, std::uint32_t b, std::vector<Holder>& holders) {
  const std::uint32_t by = outranks(atoms, a, b) ? a : b, held = by == a ? b : a;
  const double slack = atoms[by].radius - atoms[held].radius - glm::distance(atoms[held].center, atoms[by].center);
  if (slack + kSwallowTolerance >= 0) holders.push_back({held, by, slack});
}

std::vector<bool> swallowed_by(std::span<const Ball> atoms,
                               const tbb::enumerable_thread_specific<std::vector<Holder>>& found,
                               double* protruding = nullptr) {
  std::vector<Holder> holders;  // hardly any in a molecule
  for (const std::vector<Holder>& part : found) holders.insert(holders.end(), part.begin(), part.end());
  // The highest first: whether one is swallowed has been decided before it can swallow.
  std::sort(holders.begin(), holders.end(),
            [&](const Holder& x, const Holder& y) { return x.held != y.held && outranks(atoms, x.held, y.held); });
  std::vector<bool> swallowed(atoms.size(), false);
  double most = 0;
  for (std::size_t n = 0; n < holders.size();) {
    const std::uint32_t held = holders[n].held;
    double slack = -kSwallowTolerance;  // in the one that holds it best
    for (; n < holders.size() && holders[n].held == held; ++n) {
      if (swallowed[holders[n].by]) continue;
      swallowed[held] = true;
      slack = std::max(slack, holders[n].slack);
    }
    if (swallowed[held]) most = std::max(most, -slack);
  }
  if (protruding) *protruding = most;
  return swallowed;
}

}  // namespace

double scattered(std::size_t index) {
  std::uint32_t h = static_cast<std::uint32_t>(index) * 0x9e3779b9u;
  h ^= h >> 16;
  h *= 0x85ebca6bu;
  h ^= h >> 13;
  return h * 0x1p-32;
}

double decision_weight(double radius, std::size_t index) {
  const double grown = radius + growth(index);
  return grown * grown;
}

double shrunk_weight(double decision_weight, std::size_t index) {
  const double shrunk = std::sqrt(decision_weight) - 2 * growth(index);
  return shrunk > 0 ? shrunk * shrunk : 0.0;
}

double growth_as_roundoff(std::span<const double> decision_weights) {
  if (decision_weights.empty()) return geometry::kUnitRoundoff;
  const double smallest = std::sqrt(*std::ranges::min_element(decision_weights));
  const double unit = 2 * geometry::kLargestGrowth / (3 * smallest);
  return unit < 1e-6 ? unit + geometry::kUnitRoundoff : 0.0;
}

double decided_within(double roundoff, std::size_t ties, double protruding) {
  return std::max(roundoff > 0 && ties == 0 ? 0.0 : geometry::kLargestGrowth, protruding);
}

double probe_decision_weight(double probe_radius, std::size_t index) {
  const double grown = probe_radius + 1e-12 * (1.0 + 0.5 * scattered(index));
  return grown * grown;
}

std::vector<double> decision_weights(std::span<const Ball> atoms, double probe_radius, AtomNumbers numbers) {
  std::vector<double> weights(atoms.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, atoms.size(), 4096), [&](const auto& range) {
    for (std::size_t a = range.begin(); a != range.end(); ++a)
      weights[a] = decision_weight(atoms[a].radius + probe_radius, number_of(numbers, static_cast<std::uint32_t>(a)));
  });
  return weights;
}

std::vector<bool> swallowed_atoms(std::span<const Ball> atoms, double* protruding) {
  if (protruding) *protruding = 0;
  if (atoms.empty()) return {};
  tbb::enumerable_thread_specific<std::vector<Holder>> found;
  // Exact containment hands on from ball to ball, nearness does not: hence all who could swallow whom.
  for_each_pair_near(atoms, farthest_holder(atoms),
                     [&](std::uint32_t a, std::uint32_t b) { add_holder(atoms, a, b, found.local()); });
  return swallowed_by(atoms, found, protruding);
}

std::vector<bool> SwallowedAtoms::of(std::span<const Ball> atoms) {
  if (!still_near(atoms)) {  // pairs pay for atoms that stay where they are for some frames
    found_at_.assign(atoms.begin(), atoms.end());
    has_pairs_ = false;
    return swallowed_atoms(atoms);
  }
  if (!has_pairs_) find_pairs(atoms);
  tbb::enumerable_thread_specific<std::vector<Holder>> found;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pairs_.size(), 4096), [&](const auto& range) {
    std::vector<Holder>& holders = found.local();
    for (std::size_t n = range.begin(); n != range.end(); ++n) add_holder(atoms, pairs_[n][0], pairs_[n][1], holders);
  });
  return swallowed_by(atoms, found);
}

bool SwallowedAtoms::still_near(std::span<const Ball> atoms) const {
  if (atoms.size() != found_at_.size()) return false;
  std::atomic<bool> near = true;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, atoms.size(), 8192), [&](const auto& range) {
    if (!near.load(std::memory_order_relaxed)) return;
    bool these = true;
    for (std::size_t n = range.begin(); n != range.end(); ++n) {
      const glm::dvec3 d = atoms[n].center - found_at_[n].center;
      these = these && glm::dot(d, d) <= kWay * kWay && atoms[n].radius == found_at_[n].radius;
    }
    if (!these) near.store(false, std::memory_order_relaxed);
  });
  return near;
}

void SwallowedAtoms::find_pairs(std::span<const Ball> atoms) {
  constexpr double kRounding = 1e-6;  // Å: more than what differences of coordinates have
  found_at_.assign(atoms.begin(), atoms.end());
  has_pairs_ = true;
  pairs_.clear();
  if (atoms.empty()) return;
  tbb::enumerable_thread_specific<std::vector<std::array<std::uint32_t, 2>>> found;
  for_each_pair_near(atoms, farthest_holder(atoms) + 2.0 * (kWay + kRounding), [&](std::uint32_t a, std::uint32_t b) {
    found.local().push_back({a, b});
  });
  for (const auto& part : found) pairs_.insert(pairs_.end(), part.begin(), part.end());
}

}  // namespace meniscus
