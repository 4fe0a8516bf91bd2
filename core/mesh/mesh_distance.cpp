// SPDX-License-Identifier: BSD-3-Clause
// Finds the triangle of a mesh nearest to a point, by the regions of a triangle's plane (Ericson, "Real-Time Collision
// Detection", 2005, 5.1.5).
#include "core/mesh/mesh_distance.h"

#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace meniscus {
namespace {

glm::dvec3 nearest_point(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& x) {
  const auto& [a, b, c] = triangle;
  const glm::dvec3 ab = b - a, ac = c - a;
  const double d1 = glm::dot(ab, x - a), d2 = glm::dot(ac, x - a);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const double d3 = glm::dot(ab, x - b), d4 = glm::dot(ac, x - b);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double of_c = d1 * d4 - d3 * d2;
  if (of_c <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  const double d5 = glm::dot(ab, x - c), d6 = glm::dot(ac, x - c);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double of_b = d5 * d2 - d1 * d6;
  if (of_b <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  const double of_a = d3 * d6 - d5 * d4;
  if (of_a <= 0.0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double sum = of_a + of_b + of_c;
  return a + of_b / sum * ab + of_c / sum * ac;
}

std::vector<Box> boxes_of(std::span<const glm::dvec3> positions,
                          std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<Box> boxes(triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    boxes[t] = {glm::min(glm::min(positions[a], positions[b]), positions[c]),
                glm::max(glm::max(positions[a], positions[b]), positions[c])};
  }
  return boxes;
}

}  // namespace

MeshDistance::MeshDistance(std::span<const glm::dvec3> positions,
                           std::span<const std::array<std::uint32_t, 3>> triangles)
    : positions_(positions), triangles_(triangles), tree_(boxes_of(positions, triangles)) {}

std::array<glm::dvec3, 3> MeshDistance::corners(std::uint32_t triangle) const {
  const auto& [a, b, c] = triangles_[triangle];
  return {positions_[a], positions_[b], positions_[c]};
}

NearestTriangle MeshDistance::operator()(const glm::dvec3& x, double limit) const {
  NearestTriangle found{static_cast<std::uint32_t>(triangles_.size()), limit};
  tree_.nearest(x, limit, [&](std::uint32_t t, double) {
    const double distance = glm::distance(x, nearest_point(corners(t), x));
    if (distance < found.distance) found = {t, distance};
    return found.distance;
  });
  return found;
}

}  // namespace meniscus
