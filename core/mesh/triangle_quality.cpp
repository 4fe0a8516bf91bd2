// SPDX-License-Identifier: BSD-3-Clause
// Computes how near to equilateral triangles are, and whether they are folded over against the surface below them.
#include "core/mesh/triangle_quality.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

namespace meniscus {

bool TriangleQuality::is_folded(std::uint32_t vertex, const glm::dvec3& normal, double size) const {
  const MeshVertex& v = vertices_[vertex];
  return !v.on_crease() && !(glm::dot(normal, v.normal) > v.least_cosine * size);
}

double TriangleQuality::of(std::uint32_t a, const glm::dvec3& x, std::uint32_t b, std::uint32_t c) const {
  const glm::dvec3 u = positions_[b] - x, v = positions_[c] - x, w = v - u;
  const glm::dvec3 normal = glm::cross(u, v);
  const double size = glm::length(normal), squares = glm::dot(u, u) + glm::dot(v, v) + glm::dot(w, w);
  if (!(size > 0.0)) return -kFold;
  const double quality = 2.0 * std::sqrt(3.0) * size / squares;
  return is_folded(a, normal, size) || is_folded(b, normal, size) || is_folded(c, normal, size) ? quality - kFold
                                                                                                : quality;
}

double TriangleQuality::of(std::uint32_t triangle) const {
  if (known_[triangle] != kUnknown) return known_[triangle];
  const auto v = links_.corners(triangle);
  return of(v[0], positions_[v[0]], v[1], v[2]);
}

double TriangleQuality::score_around(std::uint32_t vertex) const {
  WorstQuality worst;
  links_.around(vertex, [&](std::uint32_t half) { worst.add(of(half / 3)); });
  return worst.score();
}

double TriangleQuality::score_around(std::uint32_t vertex, const glm::dvec3& x) const {
  WorstQuality worst;
  links_.around(vertex, [&](std::uint32_t half) { worst.add(of(vertex, x, links_.to(half), links_.opposite(half))); });
  return worst.score();
}

void TriangleQuality::find_all() {
  tbb::parallel_for(std::uint32_t{0}, links_.triangle_count(), [&](std::uint32_t t) {
    if (links_.lives(3 * t)) known_[t] = static_cast<float>(of(t));
  });
}

void TriangleQuality::forget_all() {
  known_.assign(known_.size(), kUnknown);
  stale_.assign(stale_.size(), 1);
}

std::vector<std::uint8_t> TriangleQuality::take_stale() {
  std::vector<std::uint8_t> stale(stale_.size(), 0);
  stale.swap(stale_);
  return stale;
}

void TriangleQuality::make_room() {
  known_.resize(links_.triangle_count(), kUnknown);
  stale_.resize(links_.triangle_count(), 1);
}

void TriangleQuality::compact() {
  std::uint32_t living = 0;
  for (std::uint32_t t = 0; t < links_.triangle_count(); ++t) {
    if (!links_.lives(3 * t)) continue;
    known_[living] = known_[t];
    stale_[living++] = stale_[t];
  }
  known_.resize(living);
  stale_.resize(living);
}

}  // namespace meniscus
