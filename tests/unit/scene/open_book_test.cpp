// SPDX-License-Identifier: BSD-3-Clause
// Buried areas in closed form, and both sides of an interface where a reader of a book has them.
#include "core/scene/molecule.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/structure/formats/read_structure.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

SurfaceRequest on_cpu(SurfaceKind kind = SurfaceKind::ses) {
  SurfaceRequest request;
  request.cpu = true;
  request.kind = kind;
  return request;
}

Structure atoms(const std::string& text) {
  const test::TemporaryFolder folder;
  return read_structure(folder.file("atoms.xyzr", text));
}

/// Returns two slabs of atoms that touch in a plane, oblique in space: the left one below it, the right one above.
Structure two_slabs(const glm::dvec3& normal) {
  Structure structure = atoms("0 0 0 1.7\n9 0 0 1.7\n");
  const Atom sample = structure.atoms.front();
  structure.atoms.clear();
  const glm::dvec3 u = glm::normalize(glm::cross(normal, glm::dvec3(0.3, -0.8, 0.5))), v = glm::cross(normal, u);
  for (int layer = -2; layer < 2; ++layer)
    for (int i = 0; i < 7; ++i)
      for (int j = 0; j < 4; ++j) {
        Atom atom = sample;
        atom.position = 3.0 * (static_cast<double>(i) * u + static_cast<double>(j) * v + (layer + 0.5) * normal);
        atom.position += 1e-3 * glm::dvec3(i * j % 3, j % 2, i % 5);
        atom.index = static_cast<std::uint32_t>(structure.atoms.size());
        structure.atoms.push_back(atom);
      }
  return structure;
}

TEST(BuriedArea, OfTwoSpheresIsTheirCaps) {
  const double probe = 1.4, near = 1.5 + probe, far = 1.8 + probe, distance = 3.7;
  const Structure structure = atoms("0 0 0 1.5\n3.7 0 0 1.8\n");
  SurfaceComputer computer(on_cpu());
  const std::vector<AtomGroup> groups = interface_groups(structure, parse_interface("index 0:index 1"));
  const std::vector<double> buried = buried_areas(structure, groups, computer, SurfaceKind::ses);
  const double plane = (distance * distance + near * near - far * far) / (2.0 * distance);
  EXPECT_NEAR(buried[0], 2.0 * std::numbers::pi * near * (near - plane), 1e-9);
  EXPECT_NEAR(buried[1], 2.0 * std::numbers::pi * far * (far - (distance - plane)), 1e-9);
  // A single group buries nothing.
  const std::vector<AtomGroup> one{{"all", {0, 1}}};
  for (const double area : buried_areas(structure, one, computer, SurfaceKind::ses)) EXPECT_EQ(area, 0.0);
}

TEST(OpenBook, ShowsBothSidesOfTheContact) {
  for (const glm::dvec3& direction : {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(-2, 1, 0.5)}) {
    Structure structure = two_slabs(glm::normalize(direction));
    std::vector<AtomGroup> groups(2);
    for (std::uint32_t a = 0; a < structure.atoms.size(); ++a)
      groups[a < structure.atoms.size() / 2 ? 0 : 1].atoms.push_back(a);
    SurfaceComputer computer(on_cpu());
    const std::vector<double> buried = buried_areas(structure, groups, computer, SurfaceKind::ses);
    const Structure before = structure;
    open_book(structure, groups, open_pages(structure, groups, buried));
    std::array<double, 2> edge{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (std::size_t side = 0; side < 2; ++side) {
      double page = std::numeric_limits<double>::infinity(), back = -page, low = page, high = -page, left = page,
             right = -page;
      for (const std::uint32_t a : groups[side].atoms) {
        const Atom& atom = structure.atoms[a];
        (buried[a] > 0.0 ? page : back) =
            buried[a] > 0.0 ? std::min(page, atom.position.z) : std::max(back, atom.position.z);
        low = std::min(low, atom.position.y);
        high = std::max(high, atom.position.y);
        left = std::min(left, atom.position.x - atom.radius);
        right = std::max(right, atom.position.x + atom.radius);
        // The side moves as a body, without the mirror image that four points out of a plane would show.
        for (const std::uint32_t b : groups[side].atoms)
          EXPECT_NEAR(glm::distance(atom.position, structure.atoms[b].position),
                      glm::distance(before.atoms[a].position, before.atoms[b].position), 1e-9);
      }
      const auto volume = [&](const Structure& s) {
        const auto at = [&](std::size_t n) { return s.atoms[groups[side].atoms[n]].position; };
        return glm::dot(at(1) - at(0), glm::cross(at(4) - at(0), at(28) - at(0)));
      };
      EXPECT_NEAR(volume(structure), volume(before), 1e-6);
      EXPECT_GT(page, back) << "buried atoms face the viewer";
      EXPECT_GT(high - low, right - left) << "the long axis is upright";
      edge[side] = side == 0 ? right : left;
    }
    EXPECT_NEAR(edge[1] - edge[0], 6.0, 1e-9);
    EXPECT_NEAR(edge[0], -3.0, 1e-9);
  }
}

TEST(OpenBook, FaultsAreNamed) {
  for (const char* text : {"A", ":B", "A:", "A:B:C"}) EXPECT_THROW(parse_interface(text), RequestError) << text;
  EXPECT_THROW(parse_interface("chain A and:B"), SelectionError);
  EXPECT_EQ(parse_interface("A,C:B").left.text(), "chain A C");
  Structure structure = atoms("0 0 0 1.5\n30 0 0 1.5\n");
  EXPECT_THROW(interface_groups(structure, parse_interface("index 0:all ")), InputError);
  EXPECT_THROW(interface_groups(structure, parse_interface("index 0:index 7")), InputError);
  const std::vector<AtomGroup> groups = interface_groups(structure, parse_interface("index 0:index 1"));
  EXPECT_THROW(open_pages(structure, groups, std::vector<double>{0.0, 0.0}), InputError);
}

}  // namespace
}  // namespace meniscus
