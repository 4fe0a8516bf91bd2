// SPDX-License-Identifier: BSD-3-Clause
// Decision weights and swallowed atoms: the two conventions every way of finding the reduced surface shares.
#include "core/surface/reduced_surface.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/surface/ball_grid.h"

namespace meniscus {
namespace {

// Atoms this little larger than the one that holds them count as inside: four times the largest growth below.
constexpr double kSwallowTolerance = 4e-9;

// Golden-ratio hash of an index to [0, 1): neighbouring indices land far apart.
double scattered(std::size_t index) {
  std::uint32_t h = static_cast<std::uint32_t>(index) * 0x9e3779b9u;
  h ^= h >> 16;
  h *= 0x85ebca6bu;
  h ^= h >> 13;
  return h * 0x1p-32;
}

}  // namespace

double decision_weight(double radius, std::size_t index) {
  const double grown = radius + 1e-9 * (1.0 + 0.5 * scattered(index));
  return grown * grown;
}

double probe_decision_weight(double probe_radius, std::size_t index) {
  const double grown = probe_radius + 1e-12 * (1.0 + 0.5 * scattered(index));
  return grown * grown;
}

std::vector<double> decision_weights(std::span<const Ball> atoms, double probe_radius) {
  std::vector<double> weights(atoms.size());
  for (std::size_t a = 0; a < atoms.size(); ++a) weights[a] = decision_weight(atoms[a].radius + probe_radius, a);
  return weights;
}

std::vector<bool> swallowed_atoms(std::span<const Ball> atoms) {
  // An atom that holds another has a centre closer than the largest radius difference.
  if (atoms.empty()) return {};
  const auto [smallest, largest] =
      std::minmax_element(atoms.begin(), atoms.end(), [](auto& a, auto& b) { return a.radius < b.radius; });
  const double reach = largest->radius - smallest->radius + kSwallowTolerance;
  const BallGrid grid(atoms, std::max(reach, 2.0));
  std::vector<char> swallowed(atoms.size(), 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, atoms.size(), 256), [&](const auto& range) {
    for (std::size_t a = range.begin(); a != range.end(); ++a)
      grid.for_each_near(atoms[a].center, reach, [&](std::uint32_t b) {
        if (b == a) return;
        const double slack = atoms[b].radius - atoms[a].radius - glm::distance(atoms[a].center, atoms[b].center);
        const bool wins = atoms[b].radius > atoms[a].radius || (atoms[b].radius == atoms[a].radius && b < a);
        if (wins && slack + kSwallowTolerance >= 0) swallowed[a] = 1;
      });
  });
  return {swallowed.begin(), swallowed.end()};
}

}  // namespace meniscus
