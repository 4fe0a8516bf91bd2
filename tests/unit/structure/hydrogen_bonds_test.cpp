// SPDX-License-Identifier: BSD-3-Clause
// Hydrogen bonds at the limits of the criterion by closed forms, and those of ubiquitin by plain loops.
#include "core/structure/bonds.h"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/structure/formats/read_structure.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

/// Makes atoms of ligands, whose residues and places follow the order in which they are added.
struct FewMolecules : Structure {
  std::uint32_t add(std::uint32_t residue, std::uint8_t element, glm::dvec3 position, const char* name = "X") {
    Atom& atom = atoms.emplace_back();
    atom.position = position;
    atom.element = element;
    atom.kind = AtomClass::ligand;
    atom.index = static_cast<std::uint32_t>(atoms.size() - 1);
    atom.residue = residue;
    atom.residue_number = static_cast<std::int32_t>(residue);
    atom.residue_name = "LIG";
    atom.name = name;
    return atom.index;
  }

  std::vector<Bond> bonds() const {
    const std::vector<bool> all(atoms.size(), true);
    return hydrogen_bonds(*this, all, all);
  }
};

glm::dvec3 towards(double degrees, double length) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return length * glm::dvec3(std::cos(angle), std::sin(angle), 0.0);
}

/// Returns the bonds of an alcohol with its hydrogen and a carbonyl at this distance (Å) and angle (degrees) of the
/// hydrogen.
std::vector<Bond> alcohol_and_carbonyl(double distance, double angle) {
  FewMolecules both;
  both.add(1, 6, towards(110.0, 1.42));
  both.add(1, 8, {});
  const glm::dvec3 hydrogen(0.96, 0.0, 0.0), oxygen = hydrogen + towards(180.0 - angle, distance);
  both.add(1, 1, hydrogen);
  both.add(2, 8, oxygen);
  both.add(2, 6, oxygen + towards(180.0 - angle, 1.22));
  return both.bonds();
}

TEST(HydrogenBonds, WithHydrogensHaveTheLimitsOfBakerAndHubbard) {
  EXPECT_EQ(alcohol_and_carbonyl(2.0, 170.0), (std::vector<Bond>{{1, 3}}));
  EXPECT_EQ(alcohol_and_carbonyl(2.499, 170.0).size(), 1u);
  EXPECT_TRUE(alcohol_and_carbonyl(2.501, 170.0).empty());
  EXPECT_EQ(alcohol_and_carbonyl(2.0, 120.1).size(), 1u);
  EXPECT_TRUE(alcohol_and_carbonyl(2.0, 119.9).empty());
}

/// Returns the bonds of an alcohol without its hydrogen and a carbonyl at this distance (Å) and angles at both oxygens.
std::vector<Bond> heavy_pair(double distance, double at_donor, double at_acceptor, double donor_bond = 1.42) {
  FewMolecules both;
  both.add(1, 6, towards(at_donor, donor_bond));
  both.add(1, 8, {});
  both.add(2, 8, {distance, 0.0, 0.0});
  both.add(2, 6, glm::dvec3(distance, 0.0, 0.0) + towards(180.0 - at_acceptor, 1.22));
  return both.bonds();
}

TEST(HydrogenBonds, WithoutHydrogensHaveTheDistanceAndTheAnglesAtBothEnds) {
  EXPECT_EQ(heavy_pair(2.8, 110.0, 120.0), (std::vector<Bond>{{1, 2}}));
  EXPECT_EQ(heavy_pair(3.499, 110.0, 120.0).size(), 1u);
  EXPECT_TRUE(heavy_pair(3.501, 110.0, 120.0).empty());
  EXPECT_EQ(heavy_pair(2.8, 90.1, 90.1).size(), 1u);
  EXPECT_TRUE(heavy_pair(2.8, 89.9, 120.0).empty());
  EXPECT_TRUE(heavy_pair(2.8, 110.0, 89.9).empty());
  EXPECT_TRUE(heavy_pair(2.8, 110.0, 120.0, 1.25).empty()) << "neither of two carboxylates has a hydrogen";
}

/// Returns the bonds of an amide nitrogen at the origin, with its hydrogen along x, and water at a place.
std::vector<Bond> amide_and_water(const glm::dvec3& water) {
  FewMolecules both;
  const std::uint32_t carbon = both.add(1, 6, towards(120.0, 1.33));
  both.add(1, 8, both.atoms[carbon].position + towards(60.0, 1.23));
  both.add(1, 6, towards(240.0, 1.46));
  both.add(1, 7, {});
  both.add(2, 8, water);
  return both.bonds();
}

TEST(HydrogenBonds, OfPlanarNitrogenHaveTheHydrogenInItsPlane) {
  EXPECT_EQ(amide_and_water({2.9, 0.0, 0.0}), (std::vector<Bond>{{3, 4}}));
  EXPECT_EQ(amide_and_water({1.01 + 2.499, 0.0, 0.0}).size(), 1u);
  EXPECT_TRUE(amide_and_water({1.01 + 2.501, 0.0, 0.0}).empty());
  EXPECT_TRUE(amide_and_water({1.0, 0.0, 2.7}).empty()) << "above the plane";
}

TEST(HydrogenBonds, AreBetweenTwoSetsAndNeverWithinAResidueOrAcrossThreeBonds) {
  FewMolecules waters;
  waters.add(1, 8, {0.0, 0.0, 0.0});
  waters.add(2, 8, {2.8, 0.0, 0.0});
  waters.add(3, 8, {5.6, 0.0, 0.0});
  EXPECT_EQ(waters.bonds(), (std::vector<Bond>{{0, 1}, {1, 2}})) << "each once, although both may be donors";
  EXPECT_EQ(hydrogen_bonds(waters, {true, false, false}, {true, true, true}), (std::vector<Bond>{{0, 1}}));
  EXPECT_EQ(hydrogen_bonds(waters, {false, false, true}, {true, true, false}), (std::vector<Bond>{{1, 2}}));
  EXPECT_TRUE(hydrogen_bonds(waters, {true, false, false}, {false, false, true}).empty());
  waters.atoms[1].model = 2;
  EXPECT_TRUE(waters.bonds().empty()) << "between models";
  waters.added.emplace_back();
  EXPECT_EQ(waters.bonds().size(), 2u) << "between files";
  waters.atoms[1].model = 1;
  waters.atoms[0].residue = waters.atoms[1].residue = waters.atoms[2].residue = 1;
  EXPECT_TRUE(waters.bonds().empty()) << "within a residue";
  // O-C-C-O in two residues.
  FewMolecules glycol;
  glycol.add(1, 8, {-0.5, 1.3, 0.0});
  glycol.add(1, 6, {0.0, 0.0, 0.0});
  glycol.add(2, 6, {1.5, 0.0, 0.0});
  glycol.add(2, 8, {2.0, 1.3, 0.0});
  EXPECT_TRUE(glycol.bonds().empty());
  EXPECT_TRUE(FewMolecules().bonds().empty());
}

/// Returns the bonds from N to O of the backbone by plain loops: number of the donor's residue, and of the acceptor's.
std::set<std::pair<int, int>> plain_backbone_bonds(const std::vector<Atom>& atoms) {
  std::map<std::pair<int, std::string>, glm::dvec3> at;
  for (const Atom& atom : atoms) at[{atom.residue_number, atom.name}] = atom.position;
  std::set<std::pair<int, int>> bonds;
  for (const auto& [donor, nitrogen] : at) {
    if (donor.second != "N" || at.contains({donor.first, "CD"})) {
      // Only proline has CD bonded to N.
      if (donor.second != "N" || glm::distance(nitrogen, at[{donor.first, "CD"}]) < 1.6) continue;
    }
    std::optional<glm::dvec3> hydrogen;
    if (const auto carbon = at.find({donor.first - 1, "C"}); carbon != at.end())
      hydrogen = nitrogen + 1.01 * glm::normalize(glm::normalize(nitrogen - carbon->second) +
                                                  glm::normalize(nitrogen - at.at({donor.first, "CA"})));
    for (const auto& [acceptor, oxygen] : at) {
      if (acceptor.second != "O" || acceptor.first == donor.first || acceptor.first + 1 == donor.first) continue;
      const auto angle = [](const glm::dvec3& a, const glm::dvec3& middle, const glm::dvec3& b) {
        return std::acos(glm::dot(glm::normalize(a - middle), glm::normalize(b - middle))) * 180.0 / std::numbers::pi;
      };
      const bool is_bond = hydrogen
                               ? glm::distance(*hydrogen, oxygen) <= 2.5 && angle(nitrogen, *hydrogen, oxygen) > 120.0
                               : glm::distance(nitrogen, oxygen) <= 3.5 &&
                                     angle(at.at({donor.first, "CA"}), nitrogen, oxygen) > 90.0 &&
                                     angle(at.at({acceptor.first, "C"}), oxygen, nitrogen) > 90.0;
      if (is_bond) bonds.insert({donor.first, acceptor.first});
    }
  }
  return bonds;
}

TEST(HydrogenBonds, OfTheBackboneOfUbiquitinAreThoseOfPlainLoops) {
  const Structure structure = read_structure(kUbiquitin, {});
  const std::vector<bool> all(structure.atoms.size(), true);
  std::set<std::pair<int, int>> found;
  for (const auto& [donor, acceptor] : hydrogen_bonds(structure, all, all)) {
    const Atom &d = structure.atoms[donor], &a = structure.atoms[acceptor];
    if (d.name != "N" || a.name != "O") continue;
    EXPECT_TRUE(found.insert({d.residue_number, a.residue_number}).second);
  }
  EXPECT_EQ(found, plain_backbone_bonds(structure.atoms));
  for (int n = 26; n <= 34; ++n) EXPECT_TRUE(found.contains({n, n - 4})) << "helix, from " << n;
  for (const auto& pair :
       {std::pair(3, 15), {5, 13}, {13, 5}, {15, 3}, {4, 65}, {6, 67}, {67, 4}, {69, 6}, {44, 68}, {68, 44}})
    EXPECT_TRUE(found.contains(pair)) << "sheet, from " << pair.first;
  EXPECT_EQ(found.count({27, 24}), 0u) << "helices have no bonds to the third residue";
}

std::vector<Atom> atoms_at(const std::vector<glm::dvec3>& places) {
  std::vector<Atom> atoms(places.size());
  for (std::size_t n = 0; n < places.size(); ++n) atoms[n].position = places[n];
  return atoms;
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
