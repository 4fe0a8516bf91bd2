// SPDX-License-Identifier: BSD-3-Clause
// Vertices move along the surface towards the middle of what is around them.
#include <cstddef>
#include <optional>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/mesh/evener.h"

namespace meniscus {
namespace {

/// How far a vertex goes towards the middle of its neighbours.
constexpr double kStep = 0.8;
/// Steps shorter than this share of the edges wanted change nothing worth the walk.
constexpr double kNoStep = 0.01;

}  // namespace

std::optional<glm::dvec3> Evener::centroid_along_crease(std::uint32_t vertex) const {
  glm::dvec3 sum(0.0);
  int count = 0;
  links_.around(vertex, [&](std::uint32_t half) {
    if (links_.crease(half) == kNone) return;
    sum += position_[links_.to(half)];
    ++count;
  });
  if (count != 2) return std::nullopt;
  return 0.5 * sum;
}

/// Of the triangles around a vertex, the mean of their centroids by area: what Lloyd's algorithm moves to.
glm::dvec3 Evener::centroid_around(std::uint32_t vertex) const {
  glm::dvec3 sum(0.0);
  double weight = 0.0;
  const glm::dvec3& x = position_[vertex];
  links_.around(vertex, [&](std::uint32_t half) {
    const glm::dvec3 u = position_[links_.to(half)] - x, v = position_[links_.opposite(half)] - x;
    const double area = glm::length(glm::cross(u, v));
    sum += area / 3.0 * (u + v);
    weight += area;
  });
  return weight > 0.0 ? x + sum / weight : x;
}

std::optional<SurfacePoint> Evener::relaxed(std::uint32_t vertex) const {
  if (pinned_[vertex] || held_[vertex]) return std::nullopt;
  const glm::dvec3& x = position_[vertex];
  SurfacePoint target;
  if (border_[vertex] != kNone) {
    const auto middle = centroid_along_crease(vertex);
    if (!middle) return std::nullopt;
    const auto on = walk_.on_border(x + kStep * (*middle - x), border_[vertex]);
    if (!on) return std::nullopt;
    target = {*on, face_[vertex]};
  } else {
    glm::dvec3 move = kStep * (centroid_around(vertex) - x);
    move -= glm::dot(move, normal_[vertex]) * normal_[vertex];
    if (glm::length(move) < kNoStep * size_[vertex]) return std::nullopt;
    const auto at = walk_.below(x + move, face_[vertex]);
    if (!at || glm::distance(at->position, x) > size_[vertex]) return std::nullopt;
    target = *at;
  }
  if (const double score = score_around(vertex, target.position); score < kPoor && score < score_around(vertex))
    return std::nullopt;
  return target;
}

/// All vertices look at where the others were, so the order in which they are asked does not count; where triangles
/// have to be kept apart they move one after another.
void Evener::relax() {
  std::vector<std::optional<SurfacePoint>> target(position_.size());
  tbb::parallel_for(std::size_t{0}, position_.size(), [&](std::size_t v) {
    const auto vertex = static_cast<std::uint32_t>(v);
    if (active_[v] && links_.vertex_lives(vertex)) target[v] = relaxed(vertex);
  });
  tbb::parallel_for(std::size_t{0}, position_.size(), [&](std::size_t v) {
    if (target[v] && !watched_[v]) settle(static_cast<std::uint32_t>(v), *target[v], border_[v]), changed_[v] = 1;
  });
  for (std::uint32_t v = 0; v < target.size(); ++v)
    if (target[v] && watched_[v])
      if (const Change move{Change::Kind::move, v, *target[v]}; is_free(move)) make(move);
  tbb::parallel_for(std::uint32_t{0}, links_.triangle_count(), [&](std::uint32_t t) {
    if (!links_.lives(3 * t)) return;
    const auto v = links_.corners(t);
    if (target[v[0]] || target[v[1]] || target[v[2]]) look_[t] = kUnseen, stale_[t] = 1;
  });
}

double Evener::score_around(std::uint32_t vertex, const glm::dvec3& x) const {
  Looks looks;
  links_.around(vertex,
                [&](std::uint32_t half) { looks.add(look(vertex, x, links_.to(half), links_.opposite(half))); });
  return looks.score();
}

}  // namespace meniscus
