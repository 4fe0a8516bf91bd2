// SPDX-License-Identifier: BSD-3-Clause
// A hashed grid (Teschner, Heidelberger, Mueller, Pomeranets & Gross, "Optimized spatial hashing", 2003).
#include "core/mesh/crossing_guard.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace meniscus {
namespace {

/// The mean longest side of listed triangles, times this, is the side of a cell.
constexpr double kCellSides = 1.2;
constexpr std::size_t kFewestBuckets = 64;

std::size_t hash(const glm::i64vec3& cell) {
  return static_cast<std::size_t>((cell.x * 73856093) ^ (cell.y * 19349663) ^ (cell.z * 83492791));
}

/// An axis-parallel box, both corners included.
struct Bounds {
  glm::dvec3 low, high;

  explicit Bounds(const PlacedTriangle& x) : low(x.low()), high(x.high()) {}
  void add(const Bounds& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  bool apart(const Bounds& other) const {
    return glm::any(glm::greaterThan(low, other.high)) || glm::any(glm::greaterThan(other.low, high));
  }
};

/// Do neighbouring triangles that all look the same way go side by side onto a plane?
bool unfolds(std::span<const PlacedTriangle> triangles) {
  glm::dvec3 sum(0.0);
  const auto normal = [](const PlacedTriangle& x) { return glm::cross(x.at[1] - x.at[0], x.at[2] - x.at[0]); };
  for (const PlacedTriangle& x : triangles) sum += normal(x);
  return std::all_of(triangles.begin(), triangles.end(),
                     [&](const PlacedTriangle& x) { return glm::dot(normal(x), sum) > 0.0; });
}

}  // namespace

PlacedTriangle CrossingGuard::placed(std::uint32_t triangle) const {
  const auto v = links_.corners(triangle);
  return {v, {positions_[v[0]], positions_[v[1]], positions_[v[2]]}};
}

/// visit(bucket) for the cells that a box touches.
template <typename Visit>
void CrossingGuard::each_cell(const glm::dvec3& from, const glm::dvec3& to, const Visit& visit) const {
  const glm::i64vec3 low(glm::floor(from / cell_)), high(glm::floor(to / cell_));
  glm::i64vec3 at = low;
  for (at.x = low.x; at.x <= high.x; ++at.x)
    for (at.y = low.y; at.y <= high.y; ++at.y)
      for (at.z = low.z; at.z <= high.z; ++at.z) visit(hash(at) & (heads_.size() - 1));
}

void CrossingGuard::list(const std::vector<std::uint8_t>& watched) {
  std::vector<std::uint32_t> listed;
  double sum = 0.0;
  for (std::uint32_t t = 0; t < links_.triangle_count(); ++t) {
    if (!links_.lives(3 * t)) continue;
    const auto v = links_.corners(t);
    if (!watched[v[0]] && !watched[v[1]] && !watched[v[2]]) continue;
    listed.push_back(t);
    const PlacedTriangle x = placed(t);
    const glm::dvec3 size = x.high() - x.low();
    sum += std::max({size.x, size.y, size.z});
  }
  if (!listed.empty()) cell_ = std::max(kCellSides * sum / static_cast<double>(listed.size()), 1e-6);
  heads_.assign(std::bit_ceil(std::max(2 * listed.size(), kFewestBuckets)), kNone);
  entries_.clear();
  for (const std::uint32_t t : listed) add(t);
}

void CrossingGuard::add(std::uint32_t triangle) {
  const Bounds box(placed(triangle));
  each_cell(box.low, box.high, [&](std::size_t bucket) {
    entries_.push_back({triangle, heads_[bucket]});
    heads_[bucket] = static_cast<std::uint32_t>(entries_.size() - 1);
  });
}

/// Finds the listed triangles that stay and whose boxes meet the one around all that are made.
void CrossingGuard::list_near(std::span<const PlacedTriangle> made, std::span<const std::uint32_t> gone) const {
  near_.clear();
  seen_.resize(links_.triangle_count(), 0);
  ++question_;
  for (const std::uint32_t t : gone) seen_[t] = question_;
  Bounds all(made[0]);
  for (const PlacedTriangle& x : made) all.add(Bounds(x));
  each_cell(all.low, all.high, [&](std::size_t bucket) {
    for (std::uint32_t e = heads_[bucket]; e != kNone; e = entries_[e].next) {
      const std::uint32_t t = entries_[e].triangle;
      if (std::exchange(seen_[t], question_) == question_ || !links_.lives(3 * t)) continue;
      const PlacedTriangle other = placed(t);
      if (!all.apart(Bounds(other))) near_.push_back(other);
    }
  });
}

std::size_t CrossingGuard::crossings(std::span<const PlacedTriangle> made, std::span<const std::uint32_t> gone) const {
  if (made.empty()) return 0;
  std::size_t count = 0;
  if (!unfolds(made))
    for (std::size_t i = 0; i < made.size(); ++i)
      for (std::size_t j = i + 1; j < made.size(); ++j) count += triangles_cross(made[i], made[j]);
  list_near(made, gone);
  for (const PlacedTriangle& x : made) {
    const Bounds box(x);
    for (const PlacedTriangle& other : near_) count += !box.apart(Bounds(other)) && triangles_cross(x, other);
  }
  return count;
}

}  // namespace meniscus
