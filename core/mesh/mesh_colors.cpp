// SPDX-License-Identifier: BSD-3-Clause
// Finds the atom, and so the colour, of each triangle, vertex and point of a mesh and of its caps.
#include "core/mesh/mesh_colors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/color/color_maps.h"
#include "core/mesh/triangle_mesh.h"
#include "core/surface/walks.h"

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

std::vector<ContactDirection> contact_directions(const Surface& surface, const ConcavePatch& patch) {
  std::vector<ContactDirection> contacts;
  for (std::uint32_t i = 0; i < patch.contact_count; ++i) {
    const std::uint32_t atom = surface.contacts[patch.first_contact + i];
    contacts.push_back({atom, glm::normalize(surface.atoms[atom].center - patch.center)});
  }
  return contacts;
}

std::vector<ContactDirection> contact_directions(const Surface& surface, const ToroidalPatch& patch,
                                                 const glm::dvec3& probe) {
  std::vector<ContactDirection> contacts;
  for (std::uint32_t atom : patch.atom) {
    contacts.push_back({atom, glm::normalize(surface.atoms[atom].center - probe)});
  }
  return contacts;
}

double tube_angle(const ToroidalPatch& patch, const glm::dvec3& position) {
  const glm::dvec3 from_center = position - patch.center;
  const double height = glm::dot(from_center, patch.axis);
  const double distance = glm::length(from_center - height * patch.axis);
  return std::atan2(height, patch.radius - distance);
}

std::array<double, 2> contact_angles(const Surface& surface, const ToroidalPatch& patch) {
  std::array<double, 2> angles{};
  for (int i = 0; i < 2; ++i) {
    const double height = glm::dot(surface.atoms[patch.atom[i]].center - patch.center, patch.axis);
    angles[i] = std::atan2(height, patch.radius);
  }
  return angles;
}

std::vector<double> color_changes(const std::vector<ContactDirection>& contacts, const glm::dvec3& probe,
                                  const Border& border) {
  const glm::dvec3 third = glm::cross(border.axis, border.start);
  auto nearest = [&](double t) {
    const glm::dvec3 x = arc_point(border, t) - probe;
    std::size_t best = 0;
    for (std::size_t i = 1; i < contacts.size(); ++i) {
      if (glm::dot(contacts[i].direction, x) > glm::dot(contacts[best].direction, x)) best = i;
    }
    return best;
  };
  std::vector<double> roots;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t j = i + 1; j < contacts.size(); ++j) {
      // The contacts i and j are equally near where a + b cos t + c sin t = 0.
      const glm::dvec3 difference = contacts[i].direction - contacts[j].direction;
      const double a = glm::dot(difference, border.center - probe);
      const double b = border.radius * glm::dot(difference, border.start);
      const double c = border.radius * glm::dot(difference, third);
      const double size = std::hypot(b, c);
      if (!(size > std::abs(a))) continue;
      const double middle = std::atan2(c, b), half = std::acos(-a / size);
      for (double t : {middle - half, middle + half}) {
        t = std::fmod(t, 2.0 * std::numbers::pi);
        if (t < 0.0) t += 2.0 * std::numbers::pi;
        if (t > 0.0 && t < border.sweep) roots.push_back(t);
      }
    }
  }
  std::sort(roots.begin(), roots.end());
  // Equidistances with different nearest contacts on their two sides are kept.
  std::vector<double> changes;
  double before = 0.0;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const double after = i + 1 < roots.size() ? roots[i + 1] : border.sweep;
    if (nearest(0.5 * (before + roots[i])) != nearest(0.5 * (roots[i] + after))) changes.push_back(roots[i]);
    before = roots[i];
  }
  return changes;
}

namespace {

constexpr double kNextAtoms = 1.0;  // Å beyond the nearest atom within which others are searched for

}  // namespace

CapAtoms::CapAtoms(std::vector<Ball> atoms, double probe_radius, std::vector<std::uint32_t> part)
    : atoms_(std::move(atoms)), part_(std::move(part)), probe_radius_(probe_radius), grid_(atoms_, [this] {
        for (const Ball& ball : atoms_) largest_ = std::max(largest_, ball.radius);
        return largest_ + probe_radius_ + kNextAtoms;
      }()) {
  if (atoms_.empty() || part_.size() != atoms_.size())
    throw Error("caps: the number of atoms and that of their parts differ");
  has_parts_ = std::ranges::any_of(part_, [this](std::uint32_t p) { return p != part_[0]; });
}

double CapAtoms::distance(std::uint32_t atom, const glm::dvec3& point) const {
  return glm::distance(point, atoms_[atom].center) - atoms_[atom].radius;
}

CapAtoms::Nearest CapAtoms::nearest(const glm::dvec3& point) const {
  // Atoms that the search misses are farther than `reach`.
  for (double reach = largest_ + probe_radius_ + kNextAtoms;; reach *= 2.0) {
    Nearest best;
    best.distance = std::numeric_limits<double>::infinity();
    grid_.for_each_near(point, reach, [&](std::uint32_t a) {
      const double d = distance(a, point);
      if (std::tie(d, a) >= std::tie(best.distance, best.atom)) return;
      best.distance = d;
      best.atom = a;
    });
    if (best.atom == kNone || best.distance > reach - largest_) continue;
    best.gap = reach - largest_ - best.distance;
    if (has_parts_)
      grid_.for_each_near(point, reach, [&](std::uint32_t a) {
        if (part_[a] != part_[best.atom]) best.gap = std::min(best.gap, distance(a, point) - best.distance);
      });
    return best;
  }
}

}  // namespace meniscus
