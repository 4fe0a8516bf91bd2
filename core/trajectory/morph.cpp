// SPDX-License-Identifier: BSD-3-Clause
// Finds the atoms that structures have in common and deforms one into the next; rotates groups of bonded atoms, and
// corrects one distance after another until the bonds have their lengths.
#include "core/trajectory/morph.h"

#include <functional>
#include <numeric>
#include <queue>

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
      throw InputError(structures[n].file, 0,
                       "has no chain that corresponds to one of {} by its sequence, with three atoms or more "
                       "to superpose",
                       escaped(structures.front().file));
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
    throw InputError(structures.front().file, 0,
                     "shares fewer than three atoms with the other structures, too few to superpose");
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

namespace {

std::vector<Distance> distances_between(std::span<const Bond> pairs, std::span<const glm::dvec3> from,
                                        std::span<const glm::dvec3> to, double share) {
  std::vector<Distance> distances;
  distances.reserve(pairs.size());
  for (const auto& [a, b] : pairs)
    distances.push_back({a, b, (1.0 - share) * glm::distance(from[a], from[b]) + share * glm::distance(to[a], to[b])});
  return distances;
}

/// Moves both atoms by this part of the error of their distance. Returns the absolute error before the move, Å.
double correct_one(const Distance& distance, double part, std::vector<glm::dvec3>& positions) {
  const glm::dvec3 line = positions[distance.b] - positions[distance.a];
  const double length = glm::length(line), error = length - distance.target;
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

/// Returns six times the volume between three bonds of an atom, Å³. Its sign is the handedness.
double volume_of(const BondNetwork::Corner& corner, std::span<const glm::dvec3> x) {
  const glm::dvec3& from = x[corner[0]];
  return glm::dot(x[corner[1]] - from, glm::cross(x[corner[2]] - from, x[corner[3]] - from));
}

/// Moves the atoms of a corner along the gradients of its volume, like SHAKE along bonds. Returns the move's length, Å.
double correct_corner(const BondNetwork::Corner& corner, double target, std::vector<glm::dvec3>& x) {
  const glm::dvec3 one = x[corner[1]] - x[corner[0]], two = x[corner[2]] - x[corner[0]],
                   three = x[corner[3]] - x[corner[0]];
  const glm::dvec3 of_one = glm::cross(two, three), of_two = glm::cross(three, one), of_three = glm::cross(one, two),
                   of_apex = -(of_one + of_two + of_three);
  const double error = glm::dot(one, of_one) - target, square = glm::dot(of_one, of_one) + glm::dot(of_two, of_two) +
                                                                glm::dot(of_three, of_three) +
                                                                glm::dot(of_apex, of_apex);
  if (square < 1e-6) return 0.0;
  const double step = -error / square;
  x[corner[0]] += step * of_apex;
  x[corner[1]] += step * of_one;
  x[corner[2]] += step * of_two;
  x[corner[3]] += step * of_three;
  return std::abs(error) / std::sqrt(square);
}

/// Returns a fraction of a rotation, which may be by more than 180°.
glm::dquat fraction_of(const glm::dquat& turn, double share) {
  const glm::dvec3 axis(turn.x, turn.y, turn.z);
  const double sine = glm::length(axis), half = std::atan2(sine, turn.w);
  if (sine < 1e-12) return {1.0, 0.0, 0.0, 0.0};
  return {std::cos(share * half), std::sin(share * half) / sine * axis};
}

/// True if an atom and its neighbours lie on one line, so that a rotation about it cannot be determined.
bool is_line(std::uint32_t atom, std::span<const std::uint32_t> adjacent, std::span<const glm::dvec3> x) {
  constexpr double kSine = 1e-3;
  const glm::dvec3 first = x[adjacent.front()] - x[atom];
  return std::ranges::all_of(adjacent, [&](std::uint32_t b) {
    const glm::dvec3 other = x[b] - x[atom];
    return glm::length(glm::cross(first, other)) <= kSine * glm::length(first) * glm::length(other);
  });
}

/// Returns the rotation of an atom and its neighbours. For atoms on one line it is the smallest rotation from one
/// direction to the other.
glm::dquat rotation_of(std::uint32_t atom, std::span<const std::uint32_t> adjacent, std::span<const glm::dvec3> from,
                       std::span<const glm::dvec3> to) {
  if (!is_line(atom, adjacent, from) && !is_line(atom, adjacent, to)) {
    std::vector<std::uint32_t> group(adjacent.begin(), adjacent.end());
    group.push_back(atom);
    return glm::normalize(glm::quat_cast(superposition(to, from, group).rotation));
  }
  const glm::dvec3 begin = from[adjacent.front()] - from[atom], end = to[adjacent.front()] - to[atom];
  const double lengths = glm::length(begin) * glm::length(end);
  const glm::dquat twice(lengths + glm::dot(begin, end), glm::cross(begin, end));
  return glm::length(twice) > 1e-6 * lengths ? glm::normalize(twice) : glm::dquat(1, 0, 0, 0);
}

void sort_once(std::vector<Bond>& pairs) {
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

}  // namespace

BondNetwork::BondNetwork(std::size_t atoms, std::span<const Bond> bonds, std::span<const std::uint32_t> constrained) {
  std::vector<bool> is_constrained(atoms, false);
  for (const std::uint32_t a : constrained) is_constrained[a] = true;
  for (const auto& [a, b] : bonds)
    if (is_constrained[a] && is_constrained[b] && a != b) bonds_.push_back({std::min(a, b), std::max(a, b)});
  list_neighbors(atoms);
  for (std::uint32_t a = 0; a < atoms; ++a) {
    const std::span<const std::uint32_t> adjacent = neighbors(a);
    for (std::size_t m = 0; m < adjacent.size(); ++m)
      for (std::size_t n = m + 1; n < adjacent.size(); ++n)
        angles_.push_back({std::min(adjacent[m], adjacent[n]), std::max(adjacent[m], adjacent[n])});
    for (std::size_t n = 2; n < adjacent.size(); ++n)
      corners_.push_back({a, adjacent[n - 2], adjacent[n - 1], adjacent[n]});
  }
  sort_once(angles_);
}

BondNetwork::BondNetwork(std::size_t atoms, std::vector<Bond> pairs) : bonds_(std::move(pairs)) {
  list_neighbors(atoms);
}

void BondNetwork::list_neighbors(std::size_t atoms) {
  sort_once(bonds_);
  std::vector<std::vector<std::uint32_t>> neighbors(atoms);
  for (const auto& [a, b] : bonds_) {
    neighbors[a].push_back(b);
    neighbors[b].push_back(a);
  }
  begin_.push_back(0);
  for (const std::vector<std::uint32_t>& adjacent : neighbors) {
    neighbor_.insert(neighbor_.end(), adjacent.begin(), adjacent.end());
    begin_.push_back(neighbor_.size());
  }
}

BondedPath::BondedPath(const BondNetwork& network, std::vector<glm::dvec3> from, std::vector<glm::dvec3> to)
    : network_(network),
      from_(std::move(from)),
      to_(std::move(to)),
      rotations_(network.atoms(), glm::dquat(1, 0, 0, 0)) {
  for (std::uint32_t a = 0; a < rotations_.size(); ++a)
    if (network.neighbors(a).size() > 1) rotations_[a] = rotation_of(a, network.neighbors(a), from_, to_);
  // An atom at the end of a chain rotates with its only neighbour.
  for (std::uint32_t a = 0; a < rotations_.size(); ++a)
    if (network.neighbors(a).size() == 1) rotations_[a] = rotations_[network.neighbors(a).front()];
  choose_directions();
}

/// Chooses the direction of each rotation. Rotations by 170° and by 190° about the same axis are similar, and must not
/// go opposite ways just because 180° is between them. Rotations of up to 120° go the shorter way. Then each other atom
/// rotates like the most similar neighbour that has been decided.
void BondedPath::choose_directions() {
  constexpr double kShort = 0.5;  // cosine of half a rotation by 120°
  std::vector<std::uint32_t> by_angle(rotations_.size());
  std::iota(by_angle.begin(), by_angle.end(), 0u);
  std::ranges::stable_sort(by_angle, std::greater{}, [this](std::uint32_t a) { return std::abs(rotations_[a].w); });
  std::vector<bool> is_decided(rotations_.size(), false);
  struct Step {
    double likeness;
    std::uint32_t from, to;
    bool operator<(const Step& other) const { return likeness < other.likeness; }
  };
  std::priority_queue<Step> steps;
  const auto decide = [&](std::uint32_t a, bool is_opposite) {
    if (is_opposite) rotations_[a] = -rotations_[a];
    is_decided[a] = true;
    for (const std::uint32_t b : network_.neighbors(a))
      if (!is_decided[b]) steps.push({std::abs(glm::dot(rotations_[a], rotations_[b])), a, b});
  };
  for (const std::uint32_t first : by_angle) {
    if (is_decided[first]) continue;
    decide(first, rotations_[first].w < 0.0);
    while (!steps.empty()) {
      const Step step = steps.top();
      steps.pop();
      if (is_decided[step.to]) continue;
      const double w = rotations_[step.to].w;
      decide(step.to, std::abs(w) >= kShort ? w < 0.0 : glm::dot(rotations_[step.from], rotations_[step.to]) < 0.0);
    }
  }
}

void BondedPath::correct(double share, std::vector<glm::dvec3>& positions) const {
  constexpr double kMoveWeight = 0.05;
  constexpr int kRounds = 60;
  rotate_groups(share, interpolate(share), kMoveWeight, kRounds, positions);
  constrain_lengths(share, {}, positions);
}

std::vector<glm::dvec3> BondedPath::interpolate(double share) const {
  std::vector<glm::dvec3> positions(from_.size());
  for (std::size_t a = 0; a < positions.size(); ++a) positions[a] = (1.0 - share) * from_[a] + share * to_[a];
  return positions;
}

void BondedPath::rotate_groups(double share, const std::vector<glm::dvec3>& instead_of, double move_weight, int rounds,
                               std::vector<glm::dvec3>& positions) const {
  std::vector<glm::dmat3> there(rotations_.size()), back(rotations_.size());
  for (std::size_t a = 0; a < rotations_.size(); ++a) {
    const glm::dquat turn = fraction_of(rotations_[a], share);
    there[a] = glm::mat3_cast(turn);
    back[a] = glm::mat3_cast(turn * glm::conjugate(rotations_[a]));
  }
  // Returns the change of the vector from b to a.
  const auto bend = [&](std::uint32_t b, std::uint32_t a) {
    const glm::dvec3 first = 0.5 * (1.0 - share) * (from_[a] - from_[b]), last = 0.5 * share * (to_[a] - to_[b]);
    return (there[a] + there[b]) * first + (back[a] + back[b]) * last - (instead_of[a] - instead_of[b]);
  };
  std::vector<glm::dvec3> bends, moves(positions.size(), glm::dvec3(0.0));
  for (std::uint32_t a = 0; a < network_.atoms(); ++a)
    for (const std::uint32_t b : network_.neighbors(a)) bends.push_back(bend(b, a));
  for (int round = 0; round < rounds; ++round) {
    std::size_t place = 0;
    for (std::uint32_t a = 0; a < network_.atoms(); ++a) {
      const std::span<const std::uint32_t> adjacent = network_.neighbors(a);
      if (adjacent.empty()) continue;
      glm::dvec3 sum(0.0);
      for (const std::uint32_t b : adjacent) sum += moves[b] + bends[place++];
      moves[a] = sum / (static_cast<double>(adjacent.size()) + move_weight);
    }
  }
  for (std::size_t a = 0; a < positions.size(); ++a) positions[a] += moves[a];
}

void BondedPath::constrain_lengths(double share, std::span<const Distance> minimum_distances,
                                   std::vector<glm::dvec3>& positions) const {
  constexpr int kRounds = 100, kLastRounds = 200;
  constexpr double kClose = 1e-3, kEnough = 0.01, kAngles = 0.5;  // Å, Å, part of a correction
  const std::vector<Distance> bonds = distances_between(network_.bonds(), from_, to_, share),
                              angles = distances_between(network_.angles(), from_, to_, share);
  std::vector<double> volumes;
  for (const BondNetwork::Corner& corner : network_.corners())
    volumes.push_back((1.0 - share) * volume_of(corner, from_) + share * volume_of(corner, to_));
  const auto shape = [&] {
    double worst = 0.0;
    for (std::size_t n = 0; n < volumes.size(); ++n)
      worst = std::max(worst, correct_corner(network_.corners()[n], volumes[n], positions));
    return worst;
  };
  const auto part = [&] {
    double worst = 0.0;
    for (const Distance& distance : minimum_distances)
      if (glm::distance(positions[distance.a], positions[distance.b]) < distance.target)
        worst = std::max(worst, correct_one(distance, 1.0, positions));
    return worst;
  };
  for (int round = 0; round < kRounds; ++round) {
    const double worst = std::max({part(), shape(), correct_all(angles, kAngles, positions)});
    if (std::max(worst, correct_all(bonds, 1.0, positions)) < kClose) return;
  }
  for (int round = 0; round < kLastRounds; ++round)
    if (correct_all(bonds, 1.0, positions) < kEnough) return;
}

}  // namespace meniscus
