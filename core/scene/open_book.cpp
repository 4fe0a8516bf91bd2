// SPDX-License-Identifier: BSD-3-Clause
// Finds the plane of an interface from its buried atoms, and turns both sides about it.
#include "core/scene/molecule.h"

#include <glm/matrix.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/camera/camera.h"
#include "core/scene/surface_objects.h"

namespace meniscus {
namespace {

constexpr double kLeastBuried = 0.01;  // Å²; smaller areas are rounding
constexpr double kGap = 6.0;           // Å between the pages

Selection side_of(std::string_view text) {
  std::string expression(text);
  if (expression.find(' ') == std::string::npos) {
    std::ranges::replace(expression, ',', ' ');
    expression = "chain " + expression;
  }
  return parse_selection(expression);
}

/// Returns the accessible area of each atom, summed over the surfaces of the division, Å².
std::vector<double> areas(const Structure& structure, const Division& division, SurfaceComputer& computer,
                          SurfaceKind kind) {
  return area_columns(structure, surface_objects(structure, division, computer), kind).back().values;
}

/// Returns the atoms of one group as a structure of its own.
Structure part_of(const Structure& structure, const AtomGroup& group) {
  Structure part;
  part.file = structure.file;
  part.report = structure.report;
  part.frame = structure.frame;
  for (const std::uint32_t a : group.atoms) part.atoms.push_back(structure.atoms[a]);
  return part;
}

/// Returns the rotation that turns `normal` to the viewer and `up` upright; both have length 1 and are at right angles.
glm::dmat3 page_rotation(const glm::dvec3& normal, const glm::dvec3& up) {
  return glm::transpose(glm::dmat3(glm::cross(up, normal), up, normal));
}

}  // namespace

InterfaceRequest parse_interface(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos || colon == 0 || colon + 1 == text.size() ||
      text.find(':', colon + 1) != std::string_view::npos)
    throw RequestError(in_quotes(text) + " is not A:B (chains) or EXPR:EXPR");
  return {side_of(text.substr(0, colon)), side_of(text.substr(colon + 1))};
}

std::vector<double> buried_areas(const Structure& structure, std::span<const AtomGroup> groups,
                                 SurfaceComputer& computer, SurfaceKind kind) {
  std::vector<double> buried = areas(structure, {}, computer, kind);
  for (double& area : buried) area = -area;
  for (const AtomGroup& group : groups) {
    const std::vector<double> alone = areas(part_of(structure, group), {}, computer, kind);
    for (std::size_t n = 0; n < group.atoms.size(); ++n) buried[group.atoms[n]] += alone[n];
  }
  for (double& area : buried)
    if (area < kLeastBuried) area = 0.0;
  return buried;
}

std::vector<AtomGroup> interface_groups(const Structure& structure, const InterfaceRequest& interface) {
  std::vector<AtomGroup> groups;
  std::vector<bool> taken(structure.atoms.size(), false);
  for (const Selection* side : {&interface.left, &interface.right}) {
    AtomGroup& group = groups.emplace_back();
    group.name = side->text();
    const std::vector<bool> selected = side->evaluate(structure.atoms);
    for (std::uint32_t a = 0; a < selected.size(); ++a) {
      if (!selected[a]) continue;
      if (taken[a])
        throw InputError(structure.file, 0,
                         message("@interface@: {} is on both sides", atom_place(structure.atoms[a])));
      taken[a] = true;
      group.atoms.push_back(a);
    }
    if (group.atoms.empty())
      throw InputError(structure.file, 0,
                       message("@interface@: {} selects none of the {} atoms used; {}", in_quotes(group.name),
                               with_thousands(structure.atoms.size()), side->why_none(structure.atoms)));
  }
  return groups;
}

OpenPages open_pages(const Structure& structure, std::span<const AtomGroup> groups, std::span<const double> buried) {
  std::vector<Ball> page;
  std::array<glm::dvec3, 2> middle{};
  for (std::size_t side = 0; side < 2; ++side)
    for (const std::uint32_t a : groups[side].atoms) {
      const Atom& atom = structure.atoms[a];
      middle[side] += atom.position / static_cast<double>(groups[side].atoms.size());
      if (buried[a] > 0.0) page.push_back({atom.position, atom.radius});
    }
  if (page.empty())
    throw InputError(structure.file, 0,
                     message("@interface@: these atoms do not touch: nothing is buried between them"));
  const ViewBasis flat = broad_side(page);
  OpenPages pages;
  for (const Ball& ball : page) pages.middle += ball.center / static_cast<double>(page.size());
  const glm::dvec3 across = glm::dot(middle[1] - middle[0], flat.forward) < 0.0 ? -flat.forward : flat.forward;
  pages.turn = {page_rotation(across, flat.right), page_rotation(-across, flat.right)};
  // The left page ends at the left edge of the gap, the right page begins at its right edge.
  for (std::size_t side = 0; side < 2; ++side) {
    double inner = -std::numeric_limits<double>::infinity();
    const double towards = side == 0 ? 1.0 : -1.0;
    for (const std::uint32_t a : groups[side].atoms) {
      const Atom& atom = structure.atoms[a];
      const glm::dvec3 turned = pages.turn[side] * (atom.position - pages.middle);
      inner = std::max(inner, towards * turned.x + atom.radius);
    }
    pages.step[side] = -towards * (inner + 0.5 * kGap);
  }
  return pages;
}

void open_book(Structure& structure, std::span<const AtomGroup> groups, const OpenPages& pages) {
  for (std::size_t side = 0; side < 2; ++side)
    for (const std::uint32_t a : groups[side].atoms) {
      glm::dvec3& position = structure.atoms[a].position;
      position = pages.turn[side] * (position - pages.middle);
      position.x += pages.step[side];
    }
}

}  // namespace meniscus
