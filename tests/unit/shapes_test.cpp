// SPDX-License-Identifier: BSD-3-Clause
// Bonds counted by closed forms, and what sticks, balls and spheres are made of.
#include "core/shapes/shapes.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/structure/formats/read_structure.h"
#include "core/structure/molecule_bonds.h"
#include "tests/support/run_program.h"
#include "tests/unit/pdb_line.h"

namespace meniscus {
namespace {

using test::PdbLine;
using test::TemporaryFolder;

constexpr const char* kUbiquitin = "/usr/share/freesasa/test-data/1ubq.pdb";
constexpr const char* kToxin = "/usr/share/pymol/data/demo/1tii.pdb";

Structure read_text(const TemporaryFolder& folder, const std::string& text, const ReadOptions& options = {}) {
  return read_structure(folder.file("shapes.pdb", text), options);
}

std::vector<Bond> bonds_of(const Structure& structure) { return molecule_bonds(structure.atoms, {}); }

std::string atom(const char* name, double x, char altloc = ' ', int number = 1, const char* element = " C") {
  PdbLine line;
  line.name = name;
  line.x = fmt::format("{:8.3f}", x);
  line.altloc = altloc;
  line.number = number;
  line.residue = "LIG";
  line.record = "HETATM";
  line.element = element;
  return line.text();
}

TEST(MoleculeBonds, OfAChainAreOneLessThanItsAtomsAndOneMoreForEachRing) {
  const Structure structure = read_structure(kUbiquitin, {});
  std::set<std::pair<std::string, int>> ringed;
  std::size_t rings = 0;
  for (const Atom& one : structure.atoms) {
    for (const char* name : {"HIS", "PHE", "TYR", "PRO"})
      if (one.residue_name == name && ringed.insert({name, one.residue_number}).second) ++rings;
    EXPECT_NE(one.residue_name, "TRP");
    EXPECT_NE(one.residue_name, "CYS");
  }
  EXPECT_GT(rings, 3u);
  EXPECT_EQ(bonds_of(structure).size(), structure.atoms.size() - 1 + rings);
}

TEST(MoleculeBonds, FindDisulphidesThatNoTemplateHas) {
  const Structure structure = read_structure(kToxin, {});
  std::size_t disulphides = 0;
  for (const auto& [a, b] : bonds_of(structure)) {
    EXPECT_LT(a, b);
    if (structure.atoms[a].element != 16 || structure.atoms[b].element != 16) continue;
    ++disulphides;
    EXPECT_NEAR(glm::distance(structure.atoms[a].position, structure.atoms[b].position), 2.05, 0.15);
  }
  EXPECT_EQ(disulphides, 6u);  // SSBOND records of the file
}

TEST(MoleculeBonds, DoNotCrossAlternateLocations) {
  const TemporaryFolder folder;
  ReadOptions all;
  all.altloc.rule = AltlocChoice::Rule::all;
  const std::string text = atom(" C1 ", 0.0) + atom(" C2 ", 1.5, 'A') + atom(" C2 ", 1.2, 'B') +
                           atom(" C3 ", 2.9, 'A') + atom(" C3 ", 2.6, 'B');
  EXPECT_EQ(bonds_of(read_text(folder, text, all)), (std::vector<Bond>{{0, 1}, {0, 2}, {1, 3}, {2, 4}}));
  EXPECT_EQ(bonds_of(read_text(folder, text)), (std::vector<Bond>{{0, 1}, {1, 2}}));
  // Residues of which one location each is left hold together, whatever their letters.
  const std::string two = atom(" C1 ", 0.0, 'A', 1) + atom(" C2 ", 1.5, 'B', 2);
  EXPECT_EQ(bonds_of(read_text(folder, two)), (std::vector<Bond>{{0, 1}}));
  const std::string three = two + atom(" C2 ", 1.4, 'C', 2);
  EXPECT_EQ(bonds_of(read_text(folder, three, all)), (std::vector<Bond>{}));
}

TEST(MoleculeBonds, LeaveOutDuplicatesIonsPairsOfHydrogensAndStrangers) {
  Structure structure;
  const auto add = [&](double x, std::uint8_t element, AtomClass kind = AtomClass::ligand) {
    Atom one;
    one.position = {x, 0.0, 0.0};
    one.element = element;
    one.kind = kind;
    one.index = static_cast<std::uint32_t>(structure.atoms.size());
    structure.atoms.push_back(one);
  };
  add(0.0, 6);
  add(0.3, 6);  // a duplicate
  add(10.0, 1);
  add(10.74, 1);
  add(20.0, 20, AtomClass::ion);
  add(22.2, 8);
  add(30.0, 0);
  add(31.5, 6);
  add(40.0, 6);
  add(40.0 + 0.76 + 0.76 + 0.41, 6);
  EXPECT_EQ(bonds_of(structure), std::vector<Bond>{});
  const std::vector<Bond> listed{{5, 4}, {4, 5}, {6, 7}, {0, 8}, {2, 99}};
  EXPECT_EQ(molecule_bonds(structure.atoms, listed), (std::vector<Bond>{{4, 5}, {6, 7}}));  // {0, 8} is 40 Å long
  structure.atoms[5].model = 2;
  structure.atoms[7].copy = 1;
  EXPECT_EQ(molecule_bonds(structure.atoms, listed), std::vector<Bond>{});
  EXPECT_EQ(molecule_bonds({}, {}), std::vector<Bond>{});
}

TEST(MoleculeBonds, OfAFileHoldInEachCopy) {
  Structure structure;
  for (std::uint32_t copy = 0; copy < 2; ++copy) {
    for (std::uint32_t n = 0; n < 2; ++n) {
      Atom one;
      one.position = {3.0 * n, 10.0 * copy, 0.0};
      one.element = 26;
      one.index = n + 7;
      one.copy = copy;
      structure.atoms.push_back(one);
    }
  }
  EXPECT_EQ(molecule_bonds(structure.atoms, std::vector<Bond>{{8, 7}}), (std::vector<Bond>{{0, 1}, {2, 3}}));
}

class ShapesOfThree : public testing::Test {
 protected:
  ShapesOfThree() {
    for (std::uint32_t n = 0; n < 3; ++n) {
      Atom one;
      one.position = {1.5 * n, 0.0, 0.0};
      one.radius = 1.7 + n;
      one.element = 6;
      one.index = n;
      structure_.atoms.push_back(one);
    }
    bonds_ = bonds_of(structure_);
  }

  Structure structure_;
  std::vector<Bond> bonds_;
};

TEST_F(ShapesOfThree, SticksAreCylindersWithSpheresOfTheirRadiusAtTheirEnds) {
  const Shapes all = sticks(structure_, {true, true, true}, bonds_, 0.2);
  ASSERT_EQ(all.cylinders.size(), 2u);
  ASSERT_EQ(all.spheres.size(), 3u);
  EXPECT_EQ(all.cylinders[1].from, structure_.atoms[1].position);
  EXPECT_EQ(all.cylinders[1].to, structure_.atoms[2].position);
  EXPECT_EQ(all.cylinders[1].from_atom, 1u);
  EXPECT_EQ(all.cylinders[1].to_atom, 2u);
  for (const SphereShape& sphere : all.spheres) EXPECT_EQ(sphere.radius, 0.2);
  EXPECT_FALSE(all.empty());
}

TEST_F(ShapesOfThree, AnAtomWhosePartnerIsNotSelectedIsABall) {
  const Shapes ends = sticks(structure_, {true, false, true}, bonds_, 0.5);
  EXPECT_TRUE(ends.cylinders.empty());
  ASSERT_EQ(ends.spheres.size(), 2u);
  EXPECT_EQ(ends.spheres[0].radius, 0.5);  // no thinner than a stick
  EXPECT_EQ(ends.spheres[1].radius, kBallShare * 3.7);
  EXPECT_EQ(ends.spheres[1].atom, 2u);
  EXPECT_TRUE(sticks(structure_, {false, false, false}, bonds_).empty());
}

TEST_F(ShapesOfThree, BallsHaveAShareOfTheRadiusAndSpheresAllOfIt) {
  const Shapes balls = balls_and_sticks(structure_, {true, true, false}, bonds_, 0.1, 0.2);
  ASSERT_EQ(balls.cylinders.size(), 1u);
  EXPECT_EQ(balls.cylinders[0].radius, 0.2);
  EXPECT_EQ(balls.spheres[0].radius, 0.2);
  EXPECT_EQ(balls.spheres[1].radius, 0.1 * 2.7);
  const Shapes full = spheres(structure_, {false, true, true});
  ASSERT_EQ(full.spheres.size(), 2u);
  EXPECT_EQ(full.spheres[1].radius, 3.7);
  EXPECT_TRUE(full.cylinders.empty());
}

TEST_F(ShapesOfThree, AtomsAtOnePlaceHaveNoCylinder) {
  structure_.atoms[1].position = structure_.atoms[0].position;
  const Shapes shapes = sticks(structure_, {true, true, true}, std::vector<Bond>{{0, 1}, {1, 2}});
  EXPECT_EQ(shapes.cylinders.size(), 1u);
  EXPECT_EQ(shapes.spheres[0].radius, kBallShare * 1.7);
}

TEST_F(ShapesOfThree, AppendedMeshesKeepTheirCorners) {
  Shapes one;
  one.mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, {0, 1, 2}, {{0, 1, 2}}};
  Shapes both = one;
  append(both, one);
  append(both, sticks(structure_, {true, true, true}, bonds_));
  ASSERT_EQ(both.mesh.triangles.size(), 2u);
  EXPECT_EQ(both.mesh.triangles[1], (std::array<std::uint32_t, 3>{3, 4, 5}));
  EXPECT_EQ(both.mesh.atoms.size(), 6u);
  EXPECT_EQ(both.mesh.normals.size(), 6u);
  EXPECT_EQ(both.cylinders.size(), 2u);
}

}  // namespace
}  // namespace meniscus
