// SPDX-License-Identifier: BSD-3-Clause
// Finds the atoms that structures have in common, and deforms one structure into the next.
#include "core/trajectory/morph.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/math/ball.h"
#include "core/structure/bonds.h"
#include "core/structure/superposition.h"

namespace meniscus {
namespace {

constexpr std::uint32_t kNoAtom = 0xffffffffu;

std::vector<std::uint32_t> all_of(const std::vector<Atom>& atoms) {
  std::vector<std::uint32_t> all(atoms.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

/// Returns the pairs of atoms that one, two or three bonds connect, each once and in ascending order.
std::vector<Bond> pairs_along_bonds(const BondNetwork& network) {
  std::vector<Bond> pairs;
  for (std::uint32_t a = 0; a < network.atoms(); ++a)
    for (const std::uint32_t b : network.neighbors(a)) {
      pairs.push_back({a, b});
      for (const std::uint32_t c : network.neighbors(b)) {
        pairs.push_back({a, c});
        for (const std::uint32_t d : network.neighbors(c)) pairs.push_back({a, d});
      }
    }
  std::erase_if(pairs, [](const Bond& pair) { return pair[0] >= pair[1]; });
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

CommonAtoms common_atoms(std::span<const Structure> structures, std::span<const std::vector<bool>> superposed) {
  const std::vector<Atom>& first = structures.front().atoms;
  const std::vector<bool> all_first(first.size(), true);
  // The atom of each structure but the first that corresponds to each atom of the first.
  std::vector<std::vector<std::uint32_t>> partners;
  std::vector<bool> is_common(first.size(), true), is_fitted = superposed.front();
  CommonAtoms common;
  for (std::size_t n = 1; n < structures.size(); ++n) {
    const std::vector<Atom>& other = structures[n].atoms;
    std::vector<std::uint32_t>& partner = partners.emplace_back(first.size(), kNoAtom);
    std::vector<AtomPair> fitted;
    for (const AtomPair& pair : corresponding_atoms(first, all_first, other, std::vector<bool>(other.size(), true))) {
      partner[pair.reference] = pair.moved;
      if (superposed.front()[pair.reference] && superposed[n][pair.moved]) fitted.push_back(pair);
    }
    if (fitted.size() < 3)
      throw InputError(
          structures[n].file, 0,
          fmt::format("has no chain that corresponds to one of {} by its sequence, with three atoms or more "
                      "to superpose",
                      escaped(structures.front().file)));
    common.fits.push_back(superposition(first, other, fitted));
    for (std::size_t a = 0; a < first.size(); ++a) {
      is_common[a] = is_common[a] && partner[a] != kNoAtom;
      is_fitted[a] = is_fitted[a] && is_common[a] && superposed[n][partner[a]];
    }
  }
  common.positions.resize(structures.size());
  for (std::size_t a = 0; a < first.size(); ++a) {
    if (!is_common[a]) continue;
    if (is_fitted[a]) common.fitted.push_back(static_cast<std::uint32_t>(common.atoms.size()));
    common.atoms.push_back(first[a]);
    common.positions.front().push_back(first[a].position);
    for (std::size_t n = 1; n < structures.size(); ++n)
      common.positions[n].push_back(common.fits[n - 1].motion(structures[n].atoms[partners[n - 1][a]].position));
  }
  if (common.fitted.size() < 3)
    throw InputError(structures.front().file, 0, "has fewer than three atoms to superpose that all structures have");
  return common;
}

Morph::Morph(CommonAtoms common)
    : common_(std::move(common)),
      bonds_(common_.atoms.size(), molecule_bonds(common_.atoms, {}), all_of(common_.atoms)),
      bonded_pairs_(pairs_along_bonds(bonds_)) {
  networks_.reserve(stops());  // the paths refer to the networks, which must not move
  for (std::size_t stop = 0; stop + 1 < stops(); ++stop) {
    networks_.emplace_back(common_.atoms.size(), near_pairs(stop));
    body_.emplace_back(networks_.back(), at(stop), at(stop + 1));
    path_.emplace_back(bonds_, at(stop), at(stop + 1));
  }
}

std::vector<Bond> Morph::near_pairs(std::size_t stop) const {
  constexpr double kNear = 5.0;  // Å
  std::vector<Bond> pairs(bonds_.bonds().begin(), bonds_.bonds().end());
  const std::vector<glm::dvec3>&from = at(stop), &to = at(stop + 1);
  const BallGrid grid(from, kNear);
  for (std::uint32_t a = 0; a < from.size(); ++a)
    grid.for_each_near(from[a], kNear, [&](std::uint32_t b) {
      if (a < b && glm::distance(to[a], to[b]) <= kNear) pairs.push_back({a, b});
    });
  return pairs;
}

std::vector<Distance> Morph::find_contacts(std::size_t stop, const std::vector<glm::dvec3>& positions) const {
  // Share of the radii; Å, margin for pairs that come nearer while other atoms are moved.
  constexpr double kShare = 0.8, kMargin = 0.3;
  const std::vector<glm::dvec3>&from = at(stop), &to = at(stop + 1);
  double largest = 0.0;
  for (const Atom& atom : common_.atoms) largest = std::max(largest, atom.radius);
  const BallGrid grid(positions, 2.0 * largest);
  std::vector<Distance> near;
  for (std::uint32_t a = 0; a < positions.size(); ++a)
    grid.for_each_near(positions[a], kShare * (common_.atoms[a].radius + largest) + kMargin, [&](std::uint32_t b) {
      if (a >= b || std::ranges::binary_search(bonded_pairs_, Bond{a, b})) return;
      const double least = std::min({kShare * (common_.atoms[a].radius + common_.atoms[b].radius),
                                     glm::distance(from[a], from[b]), glm::distance(to[a], to[b])});
      if (glm::distance(positions[a], positions[b]) < least + kMargin) near.push_back({a, b, least});
    });
  return near;
}

double Morph::overlap(std::size_t stop, const std::vector<glm::dvec3>& positions) const {
  double most = 0.0;
  for (const Distance& distance : find_contacts(stop, positions))
    most = std::max(most, distance.target - glm::distance(positions[distance.a], positions[distance.b]));
  return most;
}

std::vector<glm::dvec3> Morph::smooth_model(std::size_t stop, double share) const {
  constexpr double kBodyMoveWeight = 1e-3, kGroupMoveWeight = 0.05;
  constexpr int kBodyRounds = 300, kGroupRounds = 60;
  const std::vector<glm::dvec3> straight = body_[stop].interpolate(share);
  std::vector<glm::dvec3> positions = straight;
  body_[stop].rotate_groups(share, straight, kBodyMoveWeight, kBodyRounds, positions);
  path_[stop].rotate_groups(share, std::vector<glm::dvec3>(positions), kGroupMoveWeight, kGroupRounds, positions);
  // Only its neighbours determine the position of a body. It is moved back to where both stops are superposed.
  const RigidMotion back = superposition(straight, positions, common_.fitted);
  for (glm::dvec3& x : positions) x = back(x);
  return positions;
}

void Morph::constrain(std::size_t stop, double share, std::vector<glm::dvec3>& positions) const {
  constexpr int kTries = 5;
  constexpr double kEnough = 0.05;  // Å
  for (int n = 0; n < kTries; ++n) {
    path_[stop].constrain_lengths(share, find_contacts(stop, positions), positions);
    if (overlap(stop, positions) < kEnough) return;
  }
}

std::vector<std::vector<glm::dvec3>> Morph::models(std::size_t stop, std::size_t steps) const {
  constexpr int kSweeps = 30;
  constexpr double kRelaxation = 0.5;
  const auto share = [&](std::size_t n) { return static_cast<double>(n) / static_cast<double>(steps); };
  std::vector<std::vector<glm::dvec3>> models{at(stop)}, smooth{at(stop)};
  for (std::size_t n = 1; n < steps; ++n) smooth.push_back(smooth_model(stop, share(n)));
  models = smooth;
  const auto after = [&](const auto& path, std::size_t n) -> const std::vector<glm::dvec3>& {
    return n + 1 < steps ? path[n + 1] : at(stop + 1);
  };
  for (std::size_t n = 1; n < steps; ++n) constrain(stop, share(n), models[n]);
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::size_t n = 1; n < steps; ++n) {
      const std::vector<glm::dvec3>&before = models[n - 1], &next = after(models, n);
      // The bending of the smooth path itself is not straightened.
      for (std::size_t a = 0; a < models[n].size(); ++a) {
        const glm::dvec3 bend = 0.5 * (smooth[n - 1][a] + after(smooth, n)[a]) - smooth[n][a];
        models[n][a] += kRelaxation * (0.5 * (before[a] + next[a]) - models[n][a] - bend);
      }
      constrain(stop, share(n), models[n]);
    }
  return models;
}

}  // namespace meniscus
