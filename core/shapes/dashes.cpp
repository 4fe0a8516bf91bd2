// SPDX-License-Identifier: BSD-3-Clause
// Divides lines into dashes, and finds the closest pair of atoms along one axis.
#include "core/shapes/dashes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

namespace meniscus {

Shapes dashes(std::span<const Atom> atoms, std::span<const Bond> pairs, double radius) {
  constexpr double kPeriod = 0.5, kShare = 0.5;  // Å from dash to dash; share of it between the ends of a cylinder
  Shapes shapes;
  for (const auto& [from, to] : pairs) {
    const glm::dvec3 begin = atoms[from].position, along = atoms[to].position - begin;
    const double count = std::round(glm::length(along) / kPeriod);
    for (double n = 0.0; n < count; n += 1.0) {
      const std::uint32_t atom = 2.0 * n + 1.0 <= count ? from : to;
      const auto at = [&](double place) { return begin + place / count * along; };
      const glm::dvec3 first = at(n + 0.5 - 0.5 * kShare), last = at(n + 0.5 + 0.5 * kShare);
      shapes.cylinders.push_back({first, last, radius, atom, atom});
      for (const glm::dvec3& end : {first, last}) shapes.spheres.push_back({end, radius, atom});
    }
  }
  return shapes;
}

std::optional<Bond> closest_pair(std::span<const Atom> atoms, const std::vector<bool>& one,
                                 const std::vector<bool>& other) {
  std::vector<std::uint32_t> left, right;  // by ascending x
  for (std::uint32_t n = 0; n < atoms.size(); ++n) {
    if (one[n]) left.push_back(n);
    if (other[n]) right.push_back(n);
  }
  const auto x = [&](std::uint32_t n) { return atoms[n].position.x; };
  std::ranges::stable_sort(right, {}, x);
  std::pair<double, Bond> best{std::numeric_limits<double>::infinity(), {}};
  for (const std::uint32_t a : left) {
    const auto middle = std::ranges::lower_bound(right, x(a), {}, x);
    const auto look_at = [&](std::uint32_t b) {
      const double away = x(b) - x(a);
      if (away * away > best.first) return false;
      const glm::dvec3 way = atoms[b].position - atoms[a].position;
      if (a != b) best = std::min(best, std::pair{glm::dot(way, way), Bond{a, b}});
      return true;
    };
    for (auto b = middle; b != right.end() && look_at(*b); ++b) continue;
    for (auto b = middle; b != right.begin() && look_at(*std::prev(b)); --b) continue;
  }
  if (std::isinf(best.first)) return {};
  return best.second;
}

}  // namespace meniscus
