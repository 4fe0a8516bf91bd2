// SPDX-License-Identifier: BSD-3-Clause
// Decision weights and swallowed atoms: the two conventions every way of finding the reduced surface shares.
#include "core/reduced_surface/reduced_surface.h"

#include <algorithm>
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

}  // namespace

double scattered(std::size_t index) {
  std::uint32_t h = static_cast<std::uint32_t>(index) * 0x9e3779b9u;
  h ^= h >> 16;
  h *= 0x85ebca6bu;
  h ^= h >> 13;
  return h * 0x1p-32;
}

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
  // Who could swallow whom, and nobody else: exact containment hands on from ball to ball, nearness does not. Cell by
  // cell, for the cache; hardly any pair is found in a molecule.
  struct Holder {
    std::uint32_t held, by;
  };
  tbb::enumerable_thread_specific<std::vector<Holder>> found;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, atoms.size(), 256), [&](const auto& range) {
    std::vector<Holder>& holders = found.local();
    for (std::size_t n = range.begin(); n != range.end(); ++n) {
      const std::uint32_t a = grid.order()[n];
      grid.for_each_near(atoms[a].center, reach, [&](std::uint32_t b) {
        const double slack = atoms[b].radius - atoms[a].radius - glm::distance(atoms[a].center, atoms[b].center);
        if (b != a && outranks(atoms, b, a) && slack + kSwallowTolerance >= 0) holders.push_back({a, b});
      });
    }
  });
  std::vector<Holder> holders;
  for (const std::vector<Holder>& part : found) holders.insert(holders.end(), part.begin(), part.end());
  // The highest first: whether one is swallowed has been decided before it can swallow.
  std::sort(holders.begin(), holders.end(),
            [&](const Holder& x, const Holder& y) { return x.held != y.held && outranks(atoms, x.held, y.held); });
  std::vector<bool> swallowed(atoms.size(), false);
  for (const auto& [held, by] : holders)
    if (!swallowed[by]) swallowed[held] = true;
  return swallowed;
}

}  // namespace meniscus
