// SPDX-License-Identifier: BSD-3-Clause
// Computes the visibility of the sky at vertices, and its means over the triangles of atoms.
#include "core/mesh/open_sky.h"

#include <cstdint>

#include <glm/geometric.hpp>

#include "core/mesh/triangle_mesh.h"
#include "core/render/cpu/sky_visibility.h"

namespace meniscus {

std::vector<float> vertex_open_sky(const Surface& surface, const TriangleMesh& mesh) {
  return sky_visibility(surface, {mesh.positions, mesh.normals});
}

std::vector<double> atom_open_sky(const Surface& surface, const TriangleMesh& mesh) {
  const std::vector<float> seen = vertex_open_sky(surface, mesh);
  std::vector<double> means(surface.atoms.size(), 0.0), areas = means;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const glm::dvec3 &from = mesh.positions[a], side = mesh.positions[b] - from, other = mesh.positions[c] - from;
    const double area = glm::length(glm::cross(side, other));
    means[mesh.atom[t]] += area * static_cast<double>(seen[a] + seen[b] + seen[c]) / 3.0;
    areas[mesh.atom[t]] += area;
  }
  for (std::size_t n = 0; n < means.size(); ++n)
    if (areas[n] > 0.0) means[n] /= areas[n];
  return means;
}

}  // namespace meniscus
