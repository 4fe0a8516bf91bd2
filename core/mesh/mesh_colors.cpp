// SPDX-License-Identifier: BSD-3-Clause
// Turns colours of atoms into colours of a mesh's triangles and vertices.
#include "core/mesh/mesh_colors.h"

#include <algorithm>

#include <glm/common.hpp>

#include "core/color/volume_paint.h"
#include "core/mesh/triangle_mesh.h"

namespace meniscus {

glm::vec3 triangle_color(const TriangleMesh& mesh, const Coloring& coloring, std::size_t triangle) {
  if (coloring.kind) return (*coloring.kind)[static_cast<std::size_t>(mesh.kind[triangle])];
  return coloring.atom[mesh.atom[triangle]];
}

std::vector<glm::vec3> vertex_colors(const TriangleMesh& mesh, const Coloring& coloring) {
  std::vector<glm::vec3> sum(mesh.positions.size(), glm::vec3(0.0f));
  std::vector<float> count(mesh.positions.size(), 0.0f);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::vec3 color = triangle_color(mesh, coloring, t);
    for (const std::uint32_t v : mesh.triangles[t]) {
      sum[v] += color;
      count[v] += 1.0f;
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) sum[v] /= std::max(count[v], 1.0f);
  if (!coloring.volume) return sum;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (coloring.by_volume(mesh.atom[t]))
      for (const std::uint32_t v : mesh.triangles[t])
        sum[v] = coloring.volume->color(mesh.positions[v], mesh.normals[v]);
  return sum;
}

std::vector<float> vertex_map_values(const TriangleMesh& mesh, const VolumePaint& volume) {
  std::vector<float> values;
  values.reserve(mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    values.push_back(static_cast<float>(volume.value(mesh.positions[v], mesh.normals[v])));
  return values;
}

std::vector<std::uint32_t> vertex_atoms(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> atom(mesh.positions.size(), kNone);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) atom[v] = std::min(atom[v], mesh.atom[t]);
  }
  return atom;
}

glm::dvec3 mesh_origin(const TriangleMesh& mesh) {
  if (mesh.positions.empty()) return glm::dvec3(0.0);
  glm::dvec3 low = mesh.positions.front(), high = low;
  for (const glm::dvec3& x : mesh.positions) {
    low = glm::min(low, x);
    high = glm::max(high, x);
  }
  return glm::round(0.5 * (low + high));
}

}  // namespace meniscus
