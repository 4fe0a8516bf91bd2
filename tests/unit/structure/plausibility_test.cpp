// SPDX-License-Identifier: BSD-3-Clause
// Warnings of coincident atoms and of wrong units, against searches through all pairs.
#include "core/structure/plausibility.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/structure/structure.h"

namespace meniscus {
namespace {

// Returns randomly placed atoms in a box of this edge.
Structure scattered_atoms(std::size_t count, double edge) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-edge / 2, edge / 2);
  Structure structure;
  for (std::uint32_t n = 0; n < count; ++n) {
    Atom& atom = structure.atoms.emplace_back();
    atom.position = {place(random), place(random), place(random)};
    atom.index = n;
    atom.name = fmt::format("C{}", n);
  }
  return structure;
}

TEST(CoincidentAtoms, AreNamedWithTheFirstOneOfTheirPlace) {
  Structure structure = scattered_atoms(300, 20);
  std::vector<Atom>& atoms = structure.atoms;
  warn_of_coincident_atoms(structure);
  EXPECT_TRUE(structure.report.warnings.empty());
  atoms[0].position = {0.0, 1.5, 0.0};
  atoms[120].position = {-0.0, 1.5, -0.0};
  atoms[299].position = atoms[120].position;
  atoms[40].position = atoms[30].position;
  atoms[50].position = atoms[30].position + glm::dvec3(0, 0, 1e-9);
  warn_of_coincident_atoms(structure);
  ASSERT_EQ(structure.report.warnings.size(), 1u);
  const auto at = [&](std::size_t n, std::size_t first) {
    return label_of(atoms[n]) + " at " + label_of(atoms[first]);
  };
  EXPECT_EQ(structure.report.warnings[0].details, (std::vector{at(40, 30), at(120, 0), at(299, 0)}));
  EXPECT_EQ(
      structure.report.warnings[0].text,
      "3 atoms lie at exactly the position of another; the surface treats them as one (first: " + at(40, 30) + ")");
}

TEST(OverlaidModels, AreToldFromModelsBesideEachOther) {
  const auto warnings = [](double apart) {
    Structure structure = scattered_atoms(400, 15);
    const std::vector<Atom> first = structure.atoms;
    for (Atom atom : first) {
      atom.model = 2;
      atom.position += glm::dvec3(apart, 0.0, 0.0);
      structure.atoms.push_back(atom);
    }
    structure.report.models = 2;
    warn_of_overlaid_models(structure);
    return structure.report.warnings;
  };
  ASSERT_EQ(warnings(0.7).size(), 1u);
  EXPECT_EQ(warnings(0.7)[0].text,
            "2 models lie on one another, as states of one molecule do; the surface is that of all of them together; "
            "--model 1 takes one");
  EXPECT_TRUE(warnings(16.0).empty());
  Structure one = scattered_atoms(400, 15);
  warn_of_overlaid_models(one);
  EXPECT_TRUE(one.report.warnings.empty());
}

TEST(CoincidentAtoms, MayBeThoseOfSuperposedFiles) {
  Structure structure = scattered_atoms(30, 5);
  structure.atoms[20].position = structure.atoms[10].position;
  structure.atoms[20].model = 2;
  structure.added.emplace_back();
  warn_of_coincident_atoms(structure);
  EXPECT_TRUE(structure.report.warnings.empty());
  structure.added.clear();
  warn_of_coincident_atoms(structure);
  EXPECT_EQ(structure.report.warnings.size(), 1u);
}

double median_of_nearest(const std::vector<Atom>& atoms) {
  const std::size_t step = (atoms.size() + 63) / 64;
  std::vector<double> distances;
  for (std::size_t n = 0; n < atoms.size(); n += step) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Atom& other : atoms)
      if (&other != &atoms[n] && other.model == atoms[n].model && other.altloc == atoms[n].altloc)
        nearest = std::min(nearest, glm::distance(other.position, atoms[n].position));
    distances.push_back(nearest);
  }
  std::ranges::sort(distances);
  return distances[distances.size() / 2];
}

TEST(WrongUnit, IsToldByTheMedianOfTheNearest) {
  for (const std::size_t count : {8u, 63u, 64u, 65u, 1000u}) {
    Structure structure = scattered_atoms(count, 0.5 * std::cbrt(static_cast<double>(count)));
    const double median = median_of_nearest(structure.atoms);
    ASSERT_LT(median, 0.5) << count;
    warn_of_wrong_unit(structure);
    ASSERT_EQ(structure.report.warnings.size(), 1u) << count;
    EXPECT_EQ(
        structure.report.warnings[0].text,
        fmt::format("atoms lie {:.2f} Å from their nearest neighbour (median); are the coordinates in nanometres?",
                    median));
  }
}

TEST(WrongUnit, IsNotDoubtedForOtherModelsAndLocations) {
  for (const int kind : {0, 1, 2}) {
    Structure structure = scattered_atoms(60, 40);
    for (std::size_t n = 0; n < 60; n += 2) {
      Atom& twin = structure.atoms[n + 1];
      twin.position = structure.atoms[n].position + glm::dvec3(0.1, 0, 0);
      if (kind == 1) twin.model = 2;
      if (kind == 2) twin.altloc = 'B';
    }
    warn_of_wrong_unit(structure);
    EXPECT_EQ(structure.report.warnings.empty(), kind != 0) << kind;
  }
}

}  // namespace
}  // namespace meniscus
