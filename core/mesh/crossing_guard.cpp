// SPDX-License-Identifier: BSD-3-Clause
// Counts the triangles of a changing mesh that new triangles would pass through, in the places where it is near itself.
#include "core/mesh/crossing_guard.h"

#include <algorithm>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/math/box_tree.h"
#include "core/mesh/remesh_tuning.h"
#include "core/math/ball.h"

namespace meniscus {
namespace {

/// The mean longest side of listed triangles, times this, is the side of a cell.
constexpr double kCellSides = 1.2;

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

void CrossingGuard::mark(std::span<const Ball> places, std::uint8_t how) {
  if (!places.empty()) {
    std::vector<Box> boxes;
    for (const Ball& place : places) boxes.push_back({place.center - place.radius, place.center + place.radius});
    const BoxTree tree(boxes);
    tbb::parallel_for(std::size_t{0}, positions_.size(), [&](std::size_t v) {
      constexpr double kInside = 1e-9;
      tree.nearest(positions_[v], kInside, [&](std::uint32_t p, double limit) {
        if (glm::distance(positions_[v], places[p].center) > places[p].radius) return limit;
        watched_[v] |= how;
        return 0.0;
      });
    });
  }
  list();
}

void CrossingGuard::watch_around(std::span<const std::uint32_t> triangles) {
  std::vector<Ball> places;
  for (const std::uint32_t t : triangles) {
    const PlacedTriangle x = placed(t);
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, glm::distance(x.at[k], x.at[(k + 1) % 3]));
    places.push_back({(x.at[0] + x.at[1] + x.at[2]) / 3.0, RemeshTuning::mending_reach * longest});
  }
  mark(places, kForNow);
}

void CrossingGuard::release() {
  for (std::uint8_t& how : watched_) how &= kLasting;
  list();
}

void CrossingGuard::compact(std::span<const std::uint32_t> old_vertices) {
  for (std::size_t v = 0; v < old_vertices.size(); ++v) watched_[v] = watched_[old_vertices[v]];
  watched_.resize(old_vertices.size());
  list();
}

/// Forgets all, and lists the triangles that have a watched vertex.
void CrossingGuard::list() {
  std::vector<std::uint32_t> listed;
  double sum = 0.0;
  for (std::uint32_t t = 0; t < links_.triangle_count(); ++t) {
    if (!links_.lives(3 * t)) continue;
    const auto v = links_.corners(t);
    if (!watched_[v[0]] && !watched_[v[1]] && !watched_[v[2]]) continue;
    listed.push_back(t);
    sum += longest_side(placed(t).box());
  }
  const double mean = listed.empty() ? 1.0 : sum / static_cast<double>(listed.size());
  grid_ = BoxGrid(std::max(kCellSides * mean, 1e-6), listed.size());
  for (const std::uint32_t t : listed) add(t);
}

void CrossingGuard::add(std::uint32_t triangle) { grid_.add(triangle, placed(triangle).box()); }

/// Finds the listed triangles that stay and whose boxes meet the one around all that are made.
void CrossingGuard::list_near(std::span<const PlacedTriangle> made, std::span<const std::uint32_t> gone) const {
  near_.clear();
  seen_.resize(links_.triangle_count(), 0);
  ++question_;
  for (const std::uint32_t t : gone) seen_[t] = question_;
  Box all = made[0].box();
  for (const PlacedTriangle& x : made) {
    const Box box = x.box();
    all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
  }
  grid_.for_each_near(all, [&](std::uint32_t t) {
    if (std::exchange(seen_[t], question_) == question_ || !links_.lives(3 * t)) return;
    const PlacedTriangle other = placed(t);
    if (!are_apart(all, other.box())) near_.push_back(other);
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
    const Box box = x.box();
    for (const PlacedTriangle& other : near_) count += !are_apart(box, other.box()) && triangles_cross(x, other);
  }
  return count;
}

}  // namespace meniscus
