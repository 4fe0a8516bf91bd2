// SPDX-License-Identifier: BSD-3-Clause
// Turns groups of bonded atoms, and corrects one distance after another until the bonds have their lengths.
#include "core/trajectory/bonded_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "core/structure/superposition.h"

namespace meniscus {
namespace {

/// Two atoms and how far apart they are to be, Å.
struct Distance {
  std::uint32_t a, b;
  double wanted;
};

std::vector<Distance> distances_between(std::span<const Bond> pairs, std::span<const glm::dvec3> from,
                                        std::span<const glm::dvec3> to, double share) {
  std::vector<Distance> distances;
  distances.reserve(pairs.size());
  for (const auto& [a, b] : pairs)
    distances.push_back({a, b, (1.0 - share) * glm::distance(from[a], from[b]) + share * glm::distance(to[a], to[b])});
  return distances;
}

/// Moves both atoms by a part of what is missing; returns by how much the distance was wrong.
double correct_one(const Distance& distance, double part, std::vector<glm::dvec3>& positions) {
  const glm::dvec3 line = positions[distance.b] - positions[distance.a];
  const double length = glm::length(line), error = length - distance.wanted;
  if (length > 0.0) {
    const glm::dvec3 step = (0.5 * part * error / length) * line;
    positions[distance.a] += step;
    positions[distance.b] -= step;
  }
  return std::abs(error);
}

double correct_all(std::span<const Distance> distances, double part, std::vector<glm::dvec3>& positions) {
  double most = 0.0;
  for (const Distance& distance : distances) most = std::max(most, correct_one(distance, part, positions));
  return most;
}

void sort_once(std::vector<Bond>& pairs) {
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

}  // namespace

BondNetwork::BondNetwork(std::size_t atoms, std::span<const Bond> bonds, std::span<const std::uint32_t> held) {
  std::vector<bool> is_held(atoms, false);
  for (const std::uint32_t a : held) is_held[a] = true;
  for (const auto& [a, b] : bonds)
    if (is_held[a] && is_held[b] && a != b) bonds_.push_back({std::min(a, b), std::max(a, b)});
  sort_once(bonds_);
  std::vector<std::vector<std::uint32_t>> neighbors(atoms);
  for (const auto& [a, b] : bonds_) {
    neighbors[a].push_back(b);
    neighbors[b].push_back(a);
  }
  begin_.push_back(0);
  for (const std::vector<std::uint32_t>& around : neighbors) {
    for (std::size_t m = 0; m < around.size(); ++m)
      for (std::size_t n = m + 1; n < around.size(); ++n)
        angles_.push_back({std::min(around[m], around[n]), std::max(around[m], around[n])});
    neighbor_.insert(neighbor_.end(), around.begin(), around.end());
    begin_.push_back(neighbor_.size());
  }
  sort_once(angles_);
}

BondedPath::BondedPath(const BondNetwork& network, std::vector<glm::dvec3> from, std::vector<glm::dvec3> to)
    : network_(network), from_(std::move(from)), to_(std::move(to)), turns_(network.atoms(), glm::dquat(1, 0, 0, 0)) {
  std::vector<std::uint32_t> group;
  for (std::uint32_t a = 0; a < turns_.size(); ++a) {
    const std::span<const std::uint32_t> around = network.neighbors(a);
    if (around.size() < 2) continue;
    group.assign(around.begin(), around.end());
    group.push_back(a);
    turns_[a] = glm::normalize(glm::quat_cast(superposition(to_, from_, group).rotation));
    if (turns_[a].w < 0.0) turns_[a] = -turns_[a];  // the shorter way
  }
  // An atom at the end of a chain turns with the one that it hangs on.
  for (std::uint32_t a = 0; a < turns_.size(); ++a)
    if (network.neighbors(a).size() == 1) turns_[a] = turns_[network.neighbors(a).front()];
}

void BondedPath::correct(double share, std::vector<glm::dvec3>& positions) const {
  turn_groups(share, positions);
  hold_lengths(share, positions);
}

/// By how much a bond that turns differs from one on a straight way is what two bonded atoms are moved apart; the least
/// squares of what is left of that, and of all moves, by Gauss and Seidel.
void BondedPath::turn_groups(double share, std::vector<glm::dvec3>& positions) const {
  constexpr int kRounds = 60;
  constexpr double kStay = 0.05;  // weight of a move beside that of a bond
  const glm::dquat still(1, 0, 0, 0);
  std::vector<glm::dquat> there(turns_.size()), back(turns_.size());
  for (std::size_t a = 0; a < turns_.size(); ++a) {
    there[a] = glm::slerp(still, turns_[a], share);
    back[a] = there[a] * glm::conjugate(turns_[a]);
  }
  const auto bend = [&](std::uint32_t a, std::uint32_t b) {
    const glm::dvec3 first = from_[b] - from_[a], last = to_[b] - to_[a];
    const auto turned = [&](std::uint32_t atom) {
      return (1.0 - share) * (there[atom] * first - first) + share * (back[atom] * last - last);
    };
    return 0.5 * (turned(a) + turned(b));
  };
  std::vector<glm::dvec3> bends, moves(positions.size(), glm::dvec3(0.0));
  for (std::uint32_t a = 0; a < network_.atoms(); ++a)
    for (const std::uint32_t b : network_.neighbors(a)) bends.push_back(bend(b, a));
  for (int round = 0; round < kRounds; ++round) {
    std::size_t place = 0;
    for (std::uint32_t a = 0; a < network_.atoms(); ++a) {
      const std::span<const std::uint32_t> around = network_.neighbors(a);
      if (around.empty()) continue;
      glm::dvec3 sum(0.0);
      for (const std::uint32_t b : around) sum += moves[b] + bends[place++];
      moves[a] = sum / (static_cast<double>(around.size()) + kStay);
    }
  }
  for (std::size_t a = 0; a < positions.size(); ++a) positions[a] += moves[a];
}

void BondedPath::hold_lengths(double share, std::vector<glm::dvec3>& positions) const {
  constexpr int kRounds = 100, kLastRounds = 200;
  constexpr double kClose = 1e-3, kEnough = 0.01, kAngles = 0.5;  // Å, Å, part of a correction
  const std::vector<Distance> bonds = distances_between(network_.bonds(), from_, to_, share),
                              angles = distances_between(network_.angles(), from_, to_, share);
  for (int round = 0; round < kRounds; ++round) {
    const double wrong = correct_all(angles, kAngles, positions);
    if (std::max(wrong, correct_all(bonds, 1.0, positions)) < kClose) return;
  }
  for (int round = 0; round < kLastRounds; ++round)
    if (correct_all(bonds, 1.0, positions) < kEnough) return;
}

}  // namespace meniscus
