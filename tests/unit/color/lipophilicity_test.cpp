// SPDX-License-Identifier: BSD-3-Clause
// The lipophilicity of amino acids against sums of another program, and the potential against its formula.
#include "core/color/lipophilicity.h"

#include <cmath>
#include <sstream>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/color/color_scale.h"
#include "tests/unit/color/colored_atoms.h"

namespace meniscus {
namespace {

TEST(Lipophilicity, OfAminoAcidsIsThatOfRdkit) {
  // Contributions by RDKit 2026.09 (_CalcCrippenContribs) of the middle residue of AAXAA, with its hydrogens and
  // charged as at pH 7, in sum.
  const struct {
    const char *residue, *atoms;
    double sum;
  } residues[] = {
      {"ALA", "N CA C O CB", -0.4953},
      {"ARG", "N CA C O CB CG CD NE CZ NH1 NH2", -3.0716},
      {"ASN", "N CA C O CB CG OD1 ND2", -1.6398},
      {"ASP", "N CA C O CB CG OD1 OD2", -2.3752},
      {"CYS", "N CA C O CB SG", -0.5854},
      {"GLN", "N CA C O CB CG CD OE1 NE2", -1.2497},
      {"GLU", "N CA C O CB CG CD OE1 OE2", -1.9851},
      {"GLY", "N CA C O", -0.8838},
      {"HIS", "N CA C O CB CG ND1 CD2 CE1 NE2", -0.5494},
      {"ILE", "N CA C O CB CG1 CG2 CD1", 0.5309},
      {"LEU", "N CA C O CB CG CD1 CD2", 0.5309},
      {"LYS", "N CA C O CB CG CD CE NZ", -1.1030},
      {"MET", "N CA C O CB CG SD CE", 0.2379},
      {"PHE", "N CA C O CB CG CD1 CD2 CE1 CE2 CZ", 0.7275},
      {"PRO", "N CA C O CB CG CD", -0.0090},
      {"SER", "N CA C O CB OG", -1.5229},
      {"THR", "N CA C O CB OG1 CG2", -1.1344},
      {"TRP", "N CA C O CB CG CD1 CD2 NE1 CE2 CE3 CZ2 CZ3 CH2", 1.2088},
      {"TYR", "N CA C O CB CG CD1 CD2 CE1 CE2 CZ OH", 0.4331},
      {"VAL", "N CA C O CB CG1 CG2", 0.1408},
  };
  for (const auto& [residue, atoms, sum] : residues) {
    std::istringstream names(atoms);
    double found = 0.0;
    for (std::string name; names >> name;) found += lipophilicity(residue, name);
    EXPECT_NEAR(found, sum, 1e-9) << residue;
  }
  EXPECT_EQ(lipophilicity("ASP", "OD1"), lipophilicity("ASP", "OD2"));
  EXPECT_EQ(lipophilicity("HID", "NE2"), lipophilicity("HIS", "NE2"));
  EXPECT_EQ(lipophilicity("LEU", "HD11"), 0.0);
  EXPECT_EQ(lipophilicity("LEU", "1HD1"), 0.0);
  for (const auto& [residue, name] : {std::pair{"HEM", "FE"}, {"LEU", "XX"}, {"", ""}, {"HOH", "O"}, {"DA", "P"}})
    EXPECT_TRUE(std::isnan(lipophilicity(residue, name))) << residue << " " << name;
}

Structure three_atoms() {
  Structure structure = four_atoms();
  structure.atoms.resize(3);
  const std::pair<const char*, const char*> names[] = {{"LEU", "CD1"}, {"LYS", "NZ"}, {"HEM", "FE"}};
  for (std::size_t a = 0; a < 3; ++a) {
    structure.atoms[a].residue_name = names[a].first;
    structure.atoms[a].name = names[a].second;
    structure.atoms[a].position = {3.7 * static_cast<double>(a), 0.3, -0.2};
  }
  return structure;
}

TEST(Lipophilicity, ThePotentialIsItsSumAtEachPoint) {
  const Structure structure = three_atoms();
  const auto paint = lipophilicity_paint(structure, scheme("lipophilicity"));
  for (const glm::dvec3& point : {glm::dvec3(0, 2.3, 0), {1.9, -2.1, 0.4}, {3.7, 0.1, 2.0}, {9.0, 2.0, -1.0}}) {
    double sum = 0.0;
    for (std::size_t a = 0; a < 2; ++a)
      sum += (a == 0 ? 0.5131 : -1.3074) * std::exp(-glm::distance(point, structure.atoms[a].position));
    EXPECT_NEAR(paint->value(point, {1, 0, 0}), sum, 0.004) << point.x;
  }
  EXPECT_EQ(paint->scale.range, (std::array<double, 2>{-0.3, 0.3}));
  ColorScheme wide = scheme("lipophilicity");
  wide.range = {{-1.0, 1.0}};
  EXPECT_EQ(color_scale(structure, wide).range[1], 1.0);
}

TEST(Lipophilicity, WhatIsNoAminoAcidHasNone) {
  Structure structure = three_atoms();
  ColorScheme wish = scheme("lipophilicity");
  wish.volume = lipophilicity_paint(structure, wish);
  const Coloring coloring = color_atoms(structure, wish);
  EXPECT_TRUE(coloring.by_volume(0) && coloring.by_volume(1) && !coloring.by_volume(2));
  EXPECT_EQ(coloring.atom[2], wish.volume->scale.missing_color);
  for (Atom& atom : structure.atoms) atom.residue_name = "HEM";
  EXPECT_NE(complaint([&] { lipophilicity_paint(structure, wish); }).find("has no amino acids"), std::string::npos);
  EXPECT_NE(complaint([] { parse_color_rule("chain A=lipophilicity"); }).find("cannot colour some of the atoms"),
            std::string::npos);
}

}  // namespace
}  // namespace meniscus
