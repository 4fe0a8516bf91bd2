// SPDX-License-Identifier: BSD-3-Clause
// Finds the nearest point of a triangle: the projection on its plane if that is inside, else a point of an edge.
#include "tests/support/distance_to_mesh.h"

#include <algorithm>
#include <array>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/math/box.h"

namespace meniscus::testing {
namespace {

glm::dvec3 nearest_on(const std::array<glm::dvec3, 3>& t, const glm::dvec3& x) {
  const glm::dvec3 n = glm::cross(t[1] - t[0], t[2] - t[0]);
  const glm::dvec3 foot = x - glm::dot(x - t[0], n) / glm::dot(n, n) * n;
  bool inside = true;
  glm::dvec3 best = t[0];
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3 edge = t[(k + 1) % 3] - t[k];
    inside = inside && glm::dot(glm::cross(edge, foot - t[k]), n) >= 0.0;
    const double share = std::clamp(glm::dot(x - t[k], edge) / glm::dot(edge, edge), 0.0, 1.0);
    const glm::dvec3 on_edge = t[k] + share * edge;
    if (glm::distance(x, on_edge) < glm::distance(x, best)) best = on_edge;
  }
  return inside ? foot : best;
}

}  // namespace

double farthest_from(const TriangleMesh& mesh, const std::vector<glm::dvec3>& points) {
  std::vector<Box> boxes;
  std::vector<std::array<glm::dvec3, 3>> corners;
  for (const auto& t : mesh.triangles) {
    corners.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
    const auto& x = corners.back();
    boxes.push_back({glm::min(glm::min(x[0], x[1]), x[2]), glm::max(glm::max(x[0], x[1]), x[2])});
  }
  const BoxTree tree(boxes);
  double farthest = 0.0;
  for (const glm::dvec3& x : points) {
    double nearest = 1e9;
    tree.nearest(x, nearest, [&](std::uint32_t t, double limit) {
      nearest = std::min(limit, glm::distance(x, nearest_on(corners[t], x)));
      return nearest;
    });
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

}  // namespace meniscus::testing
