// SPDX-License-Identifier: BSD-3-Clause
// Builds the reduced surface from exposed arcs and decides which spheres without an arc are exposed.
#include "core/reduced_surface/reduced_surface.h"

#include <atomic>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/math/ball.h"
#include "core/math/double_geometry.h"
#include "core/math/quad_geometry.h"

namespace meniscus {
namespace {

// Atoms that protrude from the atom that contains them by less than this count as swallowed: it is the distance at
// which two probe positions count as one. The circle of two spheres nearer than this would be as blurred as their
// difference.
const double kSwallowTolerance = geometry::kMergeDistance;

// True if ball a stays where two balls nearly coincide: the larger one, or of equal ones the one with the lower index.
bool outranks(std::span<const Ball> atoms, std::uint32_t a, std::uint32_t b) {
  return atoms[a].radius != atoms[b].radius ? atoms[a].radius > atoms[b].radius : a < b;
}

constexpr double kWay =
    0.7;  // Å: allowed motion of an atom; two may approach, so that bonded atoms are pairs, and few others

// Returns the growth of decision weights, Å.
double growth(std::size_t index) { return 1e-9 * (1.0 + 0.5 * scattered(index)); }

constexpr double kNoHolder = -std::numeric_limits<double>::infinity();

/// Returns the smallest distance, Å, between the spheres of an atom and of one that it could swallow; negative if the
/// other one protrudes. kNoHolder if it could not swallow it.
double slack_in(std::span<const Ball> atoms, std::uint32_t by, std::uint32_t held) {
  if (!outranks(atoms, by, held)) return kNoHolder;
  return atoms[by].radius - atoms[held].radius - glm::distance(atoms[held].center, atoms[by].center);
}
bool holds(double slack) { return slack + kSwallowTolerance >= 0; }

/// Returns the largest difference of radii: an atom that swallows another has a centre closer than that.
double farthest_holder(std::span<const Ball> atoms) {
  const auto [smallest, largest] =
      std::minmax_element(atoms.begin(), atoms.end(), [](auto& a, auto& b) { return a.radius < b.radius; });
  return largest->radius - smallest->radius + kSwallowTolerance;
}

/// Calls visit(a) for all atoms on all threads, cell by cell, for the cache.
template <typename Visit>
void for_each_atom(const BallGrid& grid, const Visit& visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, grid.order().size(), 256), [&](const auto& range) {
    for (std::size_t n = range.begin(); n != range.end(); ++n) visit(grid.order()[n]);
  });
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

// The highest-ranking atoms are decided first, so that it is known whether one is swallowed before it can swallow.
// Exact containment is transitive, nearness is not: hence all atoms that could swallow one count. N atoms in one place
// have N² / 2 such pairs, so none are listed, and only as many are tested as the largest protrusion needs.
std::vector<bool> swallowed_atoms(std::span<const Ball> atoms, double* protruding) {
  if (protruding) *protruding = 0;
  if (atoms.empty()) return {};
  const double reach = farthest_holder(atoms);
  const BallGrid grid(atoms, std::max(reach, 2.0));
  std::vector<std::uint8_t> is_candidate(atoms.size(), 0);
  for_each_atom(grid, [&](std::uint32_t a) {
    is_candidate[a] =
        grid.any_near(atoms[a].center, reach, [&](std::uint32_t b) { return holds(slack_in(atoms, b, a)); });
  });
  std::vector<std::uint32_t> candidates;  // almost none in a molecule
  for (std::uint32_t a = 0; a < atoms.size(); ++a)
    if (is_candidate[a]) candidates.push_back(a);
  std::ranges::sort(candidates, [&](std::uint32_t a, std::uint32_t b) { return outranks(atoms, a, b); });
  std::vector<bool> swallowed(atoms.size(), false);
  double most = 0;
  for (const std::uint32_t a : candidates) {
    double slack = kNoHolder;  // slack in the atom that contains it best
    grid.any_near(atoms[a].center, reach, [&](std::uint32_t b) {
      if (!swallowed[b]) slack = std::max(slack, slack_in(atoms, b, a));
      return slack >= -most;
    });
    swallowed[a] = holds(slack);
    if (swallowed[a]) most = std::max(most, std::min(-slack, kSwallowTolerance));
  }
  if (protruding) *protruding = most;
  return swallowed;
}

std::vector<bool> SwallowedAtoms::of(std::span<const Ball> atoms) {
  const bool near = still_near(atoms);
  if (near && !has_pairs_) find_pairs(atoms);
  if (near && !crowded_ && !any_holds(atoms)) return std::vector<bool>(atoms.size(), false);
  if (!near) {  // pairs pay off for atoms that stay in place for some frames
    found_at_.assign(atoms.begin(), atoms.end());
    has_pairs_ = false;
  }
  return swallowed_atoms(atoms);
}

bool SwallowedAtoms::any_holds(std::span<const Ball> atoms) const {
  std::atomic<bool> any = false;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pairs_.size(), 4096), [&](const auto& range) {
    for (std::size_t n = range.begin(); n != range.end(); ++n) {
      const auto& [a, b] = pairs_[n];
      if (holds(std::max(slack_in(atoms, a, b), slack_in(atoms, b, a)))) any.store(true, std::memory_order_relaxed);
    }
  });
  return any;
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
  constexpr double kRounding = 1e-6;      // Å: more than the rounding of differences of coordinates
  constexpr std::size_t kMostPairs = 64;  // per atom; a molecule never has more
  found_at_.assign(atoms.begin(), atoms.end());
  has_pairs_ = true;
  pairs_.clear();
  crowded_ = false;
  if (atoms.empty()) return;
  const double reach = farthest_holder(atoms) + 2.0 * (kWay + kRounding);
  const BallGrid grid(atoms, std::max(reach, 2.0));
  tbb::enumerable_thread_specific<std::vector<std::array<std::uint32_t, 2>>> found;
  for_each_atom(grid, [&](std::uint32_t a) {
    auto& mine = found.local();
    grid.any_near(atoms[a].center, reach, [&](std::uint32_t b) {
      if (a < b) mine.push_back({a, b});
      return mine.size() > kMostPairs * atoms.size();
    });
  });
  for (const auto& part : found) crowded_ = crowded_ || part.size() > kMostPairs * atoms.size();
  if (!crowded_)
    for (const auto& part : found) pairs_.insert(pairs_.end(), part.begin(), part.end());
}

namespace {

// Directions off the axes and planes in which models are symmetric; each is used with its opposite.
constexpr std::array<glm::dvec3, 3> kDirections{{{0.36, 0.48, 0.8}, {0.8, -0.6, 0.0}, {0.48, 0.64, -0.6}}};

// A bound, in roundings of the terms, on the error of a power or of a gap between squared lengths: centres are rounded
// once by their difference, radii by a root, directions by less than two units.
constexpr double kRoundings = 32 * geometry::kUnitRoundoff;

enum class Exposure { exposed, covered, doubtful };

class WholeSpheres {
 public:
  WholeSpheres(std::span<const Ball> atoms, double largest_radius, std::span<const double> weights,
               const std::vector<bool>& swallowed)
      : atoms_(atoms),
        weights_(weights),
        swallowed_(swallowed),
        largest_radius_(largest_radius),
        grid_(atoms, largest_radius) {}

  const BallGrid& grid() const { return grid_; }

  enum class Kind { buried, lone, lost };

  Kind kind_of(std::uint32_t a) const {
    bool exposed = false, covered = false;
    for (const glm::dvec3& direction : kDirections) {
      for (const Exposure point : {test(a, direction), test(a, -direction)}) {
        exposed = exposed || point == Exposure::exposed;
        covered = covered || point == Exposure::covered;
      }
      if (exposed || covered) break;
    }
    if (!exposed) return covered ? Kind::buried : Kind::lost;
    return covered || meets_another(a) ? Kind::lost : Kind::lone;
  }

 private:
  // Decides how ball b covers the point `step` from the centre of a, by the sign of its power.
  Exposure under(std::uint32_t b, std::uint32_t a, const glm::dvec3& step) const {
    const glm::dvec3 d = atoms_[b].center - atoms_[a].center;
    const double square = glm::dot(d, d), weights = weights_[a] + weights_[b];
    if (square > 4 * weights) return Exposure::exposed;
    const double power = weights_[a] + square - weights_[b] - 2 * glm::dot(step, d);
    const double error = kRoundings * (weights + square);
    if (power > error) return Exposure::exposed;
    return power < -error ? Exposure::covered : Exposure::doubtful;
  }

  // Tests the point of the sphere in this direction. The ball that covers it is near, as a rule, so the nearest cells
  // come first.
  Exposure test(std::uint32_t a, const glm::dvec3& direction) const {
    const glm::dvec3 step = std::sqrt(weights_[a]) * direction, point = atoms_[a].center + step;
    bool covered = false, doubtful = false;
    for (const double part : {0.3, 1.0}) {
      grid_.for_each_row_near(point, part * largest_radius_, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t n = first; n < last && !covered; ++n) {
          const std::uint32_t b = grid_.order()[n];
          if (b == a || swallowed_[b]) continue;
          const Exposure found = under(b, a, step);
          covered = found == Exposure::covered;
          doubtful = doubtful || found == Exposure::doubtful;
        }
      });
      if (covered) return Exposure::covered;
    }
    return doubtful ? Exposure::doubtful : Exposure::exposed;
  }

  // Returns whether the sphere meets another one, by the sign that decides whether two spheres have a circle at all.
  bool meets_another(std::uint32_t a) const {
    bool meets = false;
    const double radius = std::sqrt(weights_[a]);
    grid_.for_each_near(atoms_[a].center, radius + largest_radius_, [&](std::uint32_t b) {
      if (meets || b == a || swallowed_[b]) return;
      const glm::dvec3 d = atoms_[b].center - atoms_[a].center;
      const double sum = radius + std::sqrt(weights_[b]), gap = glm::dot(d, d) - sum * sum;
      if (std::abs(gap) > kRoundings * sum * sum) {
        meets = gap < 0;
        return;
      }
      const auto circle = quad_geometry::circle_of_two_spheres({d.x, d.y, d.z}, weights_[a], weights_[b]);
      meets = circle.radius_squared > 0;
    });
    return meets;
  }

  std::span<const Ball> atoms_;
  std::span<const double> weights_;
  const std::vector<bool>& swallowed_;
  double largest_radius_;
  BallGrid grid_;
};

}  // namespace

void find_whole_spheres(std::span<const Ball> atoms, std::span<const double> weights,
                        const std::vector<bool>& swallowed, ReducedSurface& rs) {
  rs.lone_atoms.clear();
  rs.lost_atoms.clear();
  std::vector<char> is_known(swallowed.begin(), swallowed.end());  // the others need a test
  for (const RsArc& arc : rs.arcs) is_known[arc.i] = is_known[arc.j] = 1;
  if (std::ranges::find(is_known, 0) == is_known.end()) return;
  const WholeSpheres spheres(atoms, std::sqrt(*std::ranges::max_element(weights)), weights, swallowed);
  std::vector<WholeSpheres::Kind> kinds(atoms.size(), WholeSpheres::Kind::buried);
  for_each_atom(spheres.grid(), [&](std::uint32_t a) {
    if (!is_known[a]) kinds[a] = spheres.kind_of(a);
  });
  for (std::uint32_t a = 0; a < kinds.size(); ++a) {
    if (kinds[a] == WholeSpheres::Kind::lone) rs.lone_atoms.push_back(a);
    if (kinds[a] == WholeSpheres::Kind::lost) rs.lost_atoms.push_back(a);
  }
}

}  // namespace meniscus
