// SPDX-License-Identifier: BSD-3-Clause
// Finds the directions from a probe to its contacts, and where along an arc the nearest of them changes.
#include "core/mesh/contact_colors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/surface/walks.h"

namespace meniscus {

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
      // a + b cos t + c sin t = 0 where i and j are equally near.
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
  // Of all equidistances, keep those with another nearest contact on either side.
  std::vector<double> changes;
  double before = 0.0;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const double after = i + 1 < roots.size() ? roots[i + 1] : border.sweep;
    if (nearest(0.5 * (before + roots[i])) != nearest(0.5 * (roots[i] + after))) changes.push_back(roots[i]);
    before = roots[i];
  }
  return changes;
}

}  // namespace meniscus
