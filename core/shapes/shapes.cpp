// SPDX-License-Identifier: BSD-3-Clause
// Draws bonds as cylinders, and atoms as spheres.
#include "core/shapes/shapes.h"
#include "core/math/ball.h"

#include <numeric>

namespace meniscus {
namespace {

/// Returns cylinders for the bonds between selected atoms that are apart; marks the atoms that have one.
std::vector<CylinderShape> cylinders_of(const Structure& structure, const std::vector<bool>& selected,
                                        std::span<const Bond> bonds, double radius, std::vector<bool>& bonded) {
  std::vector<CylinderShape> cylinders;
  for (const auto& [a, b] : bonds) {
    const glm::dvec3 &from = structure.atoms[a].position, &to = structure.atoms[b].position;
    if (!selected[a] || !selected[b] || from == to) continue;
    cylinders.push_back({from, to, radius, a, b});
    bonded[a] = bonded[b] = true;
  }
  return cylinders;
}

}  // namespace

Shapes sticks(const Structure& structure, const std::vector<bool>& selected, std::span<const Bond> bonds,
              double radius) {
  std::vector<bool> bonded(structure.atoms.size());
  Shapes shapes;
  shapes.cylinders = cylinders_of(structure, selected, bonds, radius, bonded);
  for (std::uint32_t n = 0; n < structure.atoms.size(); ++n) {
    const Atom& atom = structure.atoms[n];
    if (!selected[n]) continue;
    shapes.spheres.push_back({atom.position, bonded[n] ? radius : std::max(radius, kBallShare * atom.radius), n});
  }
  return shapes;
}

Shapes balls_and_sticks(const Structure& structure, const std::vector<bool>& selected, std::span<const Bond> bonds,
                        double ball_share, double stick_radius) {
  std::vector<bool> bonded(structure.atoms.size());
  Shapes shapes = spheres(structure, selected, ball_share);
  shapes.cylinders = cylinders_of(structure, selected, bonds, stick_radius, bonded);
  for (SphereShape& ball : shapes.spheres) ball.radius = std::max(ball.radius, stick_radius);
  return shapes;
}

Shapes spheres(const Structure& structure, const std::vector<bool>& selected, double share) {
  Shapes shapes;
  for (std::uint32_t n = 0; n < structure.atoms.size(); ++n)
    if (selected[n]) shapes.spheres.push_back({structure.atoms[n].position, share * structure.atoms[n].radius, n});
  return shapes;
}

Shapes dashes(const Structure& structure, std::span<const Bond> pairs, double radius) {
  Shapes shapes;
  for (const auto& [a, b] : pairs) {
    const glm::dvec3 begin = structure.atoms[a].position, along = structure.atoms[b].position - begin;
    const double count = std::round(2.0 * glm::length(along));
    for (double n = 0.0; n < count; n += 1.0) {
      const std::uint32_t atom = 2.0 * n + 1.0 <= count ? a : b;
      const glm::dvec3 from = begin + (n + 0.34) / count * along, to = begin + (n + 0.66) / count * along;
      shapes.cylinders.push_back({from, to, radius, atom, atom});
      shapes.spheres.insert(shapes.spheres.end(), {{from, radius, atom}, {to, radius, atom}});
    }
  }
  return shapes;
}

void add_plate(MeshShape& mesh, std::span<const glm::dvec3> polygon, const glm::dvec3& normal, double half_thickness,
               std::uint32_t atom) {
  const auto count = static_cast<std::uint32_t>(polygon.size());
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const glm::dvec3 middle =
      std::accumulate(polygon.begin(), polygon.end(), glm::dvec3(0.0)) / static_cast<double>(polygon.size());
  for (const double side : {1.0, -1.0}) {
    const auto add = [&](const glm::dvec3& point) {
      mesh.positions.push_back(point + side * half_thickness * normal);
      mesh.normals.emplace_back(side * normal);
      mesh.atoms.push_back(atom);
    };
    for (const glm::dvec3& point : polygon) add(point);
    add(middle);
  }
  const std::uint32_t below = first + count + 1;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t after = (k + 1) % count;
    mesh.triangles.push_back({first + count, first + k, first + after});
    mesh.triangles.push_back({below + count, below + after, below + k});
    mesh.triangles.push_back({below + k, below + after, first + after});
    mesh.triangles.push_back({below + k, first + after, first + k});
  }
}

void append(Shapes& shapes, const Shapes& more) {
  shapes.spheres.insert(shapes.spheres.end(), more.spheres.begin(), more.spheres.end());
  shapes.cylinders.insert(shapes.cylinders.end(), more.cylinders.begin(), more.cylinders.end());
  MeshShape& mesh = shapes.mesh;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), more.mesh.positions.begin(), more.mesh.positions.end());
  mesh.normals.insert(mesh.normals.end(), more.mesh.normals.begin(), more.mesh.normals.end());
  mesh.atoms.insert(mesh.atoms.end(), more.mesh.atoms.begin(), more.mesh.atoms.end());
  for (const auto& [a, b, c] : more.mesh.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

std::vector<Ball> balls_around(const Shapes& shapes) {
  std::vector<Ball> balls;
  for (const SphereShape& sphere : shapes.spheres) balls.push_back({sphere.center, sphere.radius});
  for (const CylinderShape& cylinder : shapes.cylinders) {
    balls.push_back({cylinder.from, cylinder.radius});
    balls.push_back({cylinder.to, cylinder.radius});
  }
  for (const glm::dvec3& position : shapes.mesh.positions) balls.push_back({position, 0.0});
  return balls;
}

}  // namespace meniscus
