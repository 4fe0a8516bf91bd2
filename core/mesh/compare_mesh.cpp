// SPDX-License-Identifier: BSD-3-Clause
// Compares a surface with its mesh by areas and volumes, and measures distances from points to triangles.
#include "core/mesh/compare_mesh.h"

#include <utility>

#include <fmt/format.h>

#include "core/surface/walks.h"

namespace meniscus {

namespace {

/// The most differences that are described; the others are only counted.
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

namespace {

/// Returns the point of a triangle that is nearest to x.
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

double MeshDistance::to_triangle(const glm::dvec3& x, std::uint32_t triangle) const {
  return glm::distance(x, nearest_point(corners(triangle), x));
}

NearestTriangle MeshDistance::operator()(const glm::dvec3& x, double limit) const {
  NearestTriangle found{static_cast<std::uint32_t>(triangles_.size()), limit};
  tree_.nearest(x, limit, [&](std::uint32_t t, double) {
    const double distance = to_triangle(x, t);
    if (distance < found.distance) found = {t, distance};
    return found.distance;
  });
  return found;
}

std::uint32_t MeshDistance::any_within(const glm::dvec3& x, double limit) const {
  auto found = static_cast<std::uint32_t>(triangles_.size());
  tree_.nearest(x, limit, [&](std::uint32_t t, double nearer) {
    if (nearer == 0.0 || to_triangle(x, t) >= limit) return nearer;
    found = t;
    return 0.0;
  });
  return found;
}

}  // namespace meniscus
