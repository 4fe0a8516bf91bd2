// SPDX-License-Identifier: BSD-3-Clause
// Counting edges, areas and volumes of a triangle mesh.
#include "exporters/mesh/triangle_mesh.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace meniscus {

MeshMeasure measure(const TriangleMesh& mesh, std::uint32_t component) {
  MeshMeasure m;
  std::vector<std::uint64_t> edges;  // directed: from << 32 | to
  std::vector<bool> used(mesh.positions.size(), false);
  const glm::dvec3 origin = mesh.positions.empty() ? glm::dvec3(0.0) : mesh.positions.front();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (component != kNone && mesh.component[i] != component) continue;
    const auto& t = mesh.triangles[i];
    const glm::dvec3 a = mesh.positions[t[0]] - origin, b = mesh.positions[t[1]] - origin,
                     c = mesh.positions[t[2]] - origin;
    m.area += 0.5 * glm::length(glm::cross(b - a, c - a));
    m.volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    ++m.triangle_count;
    for (int k = 0; k < 3; ++k) {
      used[t[k]] = true;
      edges.push_back(std::uint64_t{t[k]} << 32 | t[(k + 1) % 3]);
    }
  }
  m.vertex_count = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
  std::sort(edges.begin(), edges.end());
  std::vector<std::uint64_t> reversed(edges.size());
  std::transform(edges.begin(), edges.end(), reversed.begin(), [](std::uint64_t e) { return e << 32 | e >> 32; });
  std::sort(reversed.begin(), reversed.end());
  const bool once = std::adjacent_find(edges.begin(), edges.end()) == edges.end();
  const bool loops = std::any_of(edges.begin(), edges.end(), [](auto e) { return (e >> 32) == (e & 0xffffffffu); });
  m.closed = !edges.empty() && once && !loops && edges == reversed;
  m.edge_count = edges.size() / 2;
  return m;
}

}  // namespace meniscus
