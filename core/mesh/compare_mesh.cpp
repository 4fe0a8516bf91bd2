// SPDX-License-Identifier: BSD-3-Clause
// Compares areas and volumes of a surface with those of a mesh: adds up triangles, and bounds what flat ones lack.
#include "core/mesh/compare_mesh.h"

#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/surface/walks.h"

namespace meniscus {
namespace {

constexpr std::size_t kNamed = 8;

const char* name_of(PatchKind kind) {
  return kind == PatchKind::convex ? "convex" : kind == PatchKind::toroidal ? "toroidal" : "concave";
}

double curvature_radius(const Surface& surface, const Face& face) {
  return face.kind == PatchKind::convex ? surface.atoms[surface.convex[face.patch].atom].radius : surface.probe_radius;
}

double border_length(const Surface& surface, const Face& face) {
  double length = 0;
  for_each_border(surface, face, [&](const Border& border) { length += border.radius * border.sweep; });
  return length;
}

}  // namespace

std::vector<std::string> differences(const Surface& surface, const TriangleMesh& mesh) {
  std::vector<double> area(surface.faces.size(), 0.0), volume(surface.components.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const glm::dvec3 x = mesh.positions[a], normal = glm::cross(mesh.positions[b] - x, mesh.positions[c] - x);
    area[mesh.face[t]] += 0.5 * glm::length(normal);
    volume[mesh.component[t]] += glm::dot(x, normal) / 6;
  }
  std::vector<std::string> found;
  std::size_t count = 0;
  const auto add = [&](std::string text) {
    if (++count <= kNamed) found.push_back(std::move(text));
  };
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const Face& face = surface.faces[f];
    const double bound = mesh.tolerance * (4 / curvature_radius(surface, face) * face.area +
                                           2 * border_length(surface, face) + mesh.tolerance);
    if (!(std::abs(area[f] - face.area) <= bound))
      add(fmt::format("{} face {} has {:.6g} Å², its triangles {:.6g}", name_of(face.kind), f, face.area, area[f]));
  }
  for (std::size_t c = 0; c < surface.components.size(); ++c) {
    const Component& component = surface.components[c];
    if (!(std::abs(volume[c] - component.volume) <= 2 * mesh.tolerance * component.area + 1e-9))
      add(fmt::format("component {} has {:.6g} Å³, its triangles {:.6g}", c, component.volume, volume[c]));
  }
  if (count > kNamed) found.push_back(fmt::format("and {} more", count - kNamed));
  return found;
}

}  // namespace meniscus
