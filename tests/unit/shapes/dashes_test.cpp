// SPDX-License-Identifier: BSD-3-Clause
// Dashes of lines, and closest pairs as all pairs give them.
#include "core/shapes/dashes.h"

#include <cmath>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace meniscus {
namespace {

std::vector<Atom> atoms_at(const std::vector<glm::dvec3>& places) {
  std::vector<Atom> atoms(places.size());
  for (std::size_t n = 0; n < places.size(); ++n) atoms[n].position = places[n];
  return atoms;
}

TEST(Dashes, AreEquallyLongWithTheirMiddleInTheMiddleOfTheLine) {
  const std::vector<Atom> atoms = atoms_at({{1.0, 2.0, 3.0}, {1.0, 5.0, 3.0}});
  const Shapes shapes = dashes(atoms, std::vector<Bond>{{0, 1}}, 0.1);
  ASSERT_EQ(shapes.cylinders.size(), 6u);  // one each 0.5 Å
  EXPECT_EQ(shapes.spheres.size(), 12u);
  glm::dvec3 middle(0.0);
  double length = 0.0;
  for (const CylinderShape& dash : shapes.cylinders) {
    EXPECT_NEAR(glm::distance(dash.from, dash.to), 0.25, 1e-12);
    EXPECT_EQ(dash.radius, 0.1);
    EXPECT_EQ(dash.from_atom, 0.5 * (dash.from.y + dash.to.y) < 3.5 ? 0u : 1u);
    middle += (dash.from + dash.to) / 12.0;
    length += glm::distance(dash.from, dash.to);
  }
  EXPECT_NEAR(glm::distance(middle, glm::dvec3(1.0, 3.5, 3.0)), 0.0, 1e-12);
  EXPECT_NEAR(length, 1.5, 1e-12) << "half of the line";
  EXPECT_NEAR(shapes.cylinders.front().from.y, 2.125, 1e-12);
  EXPECT_TRUE(dashes(atoms, {}).empty());
  EXPECT_TRUE(dashes(atoms_at({{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}), std::vector<Bond>{{0, 1}}).empty());
}

TEST(ClosestPair, IsThatOfAllPairs) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-9.0, 9.0);
  for (int turn = 0; turn < 50; ++turn) {
    std::vector<glm::dvec3> places;
    std::vector<bool> one, other;
    for (int n = 0; n < 40; ++n) {
      places.emplace_back(coordinate(random), coordinate(random), coordinate(random));
      one.push_back(random() % 3 == 0);
      other.push_back(random() % 3 == 0);
    }
    const std::vector<Atom> atoms = atoms_at(places);
    double least = 1e9;
    for (std::size_t a = 0; a < places.size(); ++a)
      for (std::size_t b = 0; b < places.size(); ++b)
        if (a != b && one[a] && other[b]) least = std::min(least, glm::distance(places[a], places[b]));
    const std::optional<Bond> found = closest_pair(atoms, one, other);
    ASSERT_TRUE(found);
    EXPECT_TRUE(one[(*found)[0]] && other[(*found)[1]]);
    EXPECT_DOUBLE_EQ(glm::distance(places[(*found)[0]], places[(*found)[1]]), least);
  }
}

TEST(ClosestPair, IsTheFirstOfEqualOnesAndNeedsTwoAtoms) {
  const std::vector<Atom> atoms = atoms_at({{1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {5.0, 0.0, 0.0}});
  EXPECT_EQ(closest_pair(atoms, {true, false, true, true}, {false, true, false, false}), (Bond{0, 1}));
  EXPECT_EQ(closest_pair(atoms, {false, true, false, false}, {true, true, true, true}), (Bond{1, 0}));
  EXPECT_FALSE(closest_pair(atoms, {true, false, false, false}, {true, false, false, false}));
  EXPECT_FALSE(closest_pair(atoms, {false, false, false, false}, {true, true, true, true}));
}

}  // namespace
}  // namespace meniscus
