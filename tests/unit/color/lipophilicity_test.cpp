// SPDX-License-Identifier: BSD-3-Clause
// The lipophilicity of amino acids against sums of another program, and the potential against its formula.
#include "core/color/lipophilicity.h"

#include <cmath>
#include <sstream>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/color/color_schemes.h"
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
  EXPECT_NEAR(lipophilicity("HIP", "ND1") + lipophilicity("HSP", "NE2"), -1.0145, 1e-9);  // the sum for imidazolium
  EXPECT_EQ(lipophilicity("HIP", "CD2"), lipophilicity("HIS", "CD2"));
  EXPECT_EQ(lipophilicity("CYM", "SG"), -0.0024);
  EXPECT_EQ(lipophilicity("LEU", "HD11"), 0.0);
  EXPECT_EQ(lipophilicity("LEU", "1HD1"), 0.0);
  for (const auto& [residue, name] : {std::pair{"HEM", "FE"}, {"LEU", "XX"}, {"", ""}, {"HOH", "O"}, {"DA", "P"}})
    EXPECT_TRUE(std::isnan(lipophilicity(residue, name))) << residue << " " << name;
}

/// Adds atoms of one residue: "N CA C O", the first at x, the next 2.1 Å on; "O" and all later ones lie next to them.
void add_residue(Structure& structure, const char* chain, const char* residue, double x, const std::string& names) {
  const std::uint32_t number = structure.atoms.empty() ? 0 : structure.atoms.back().residue + 1;
  std::istringstream words(names);
  double beside = 0.0;
  for (std::string name; words >> name;) {
    Atom atom;
    atom.index = static_cast<std::uint32_t>(structure.atoms.size());
    atom.chain = chain;
    atom.residue_name = residue;
    atom.residue = number;
    atom.residue_number = static_cast<std::int32_t>(number);
    atom.name = name;
    atom.kind = AtomClass::polymer;
    atom.element = name[0] == 'H' ? 1 : name[0] == 'N' ? 7 : name[0] == 'O' ? 8 : name[0] == 'S' ? 16 : 6;
    const double y = 8.0 * (chain[0] - 'A');
    if (name == "N" || name == "CA" || name == "C" || name == "CH3") {
      atom.position = {x + (name == "N" || name == "CH3" ? 0.0 : name == "CA" ? 2.1 : 4.2), y, 0.0};
    } else if (name == "SG") {
      atom.position = {x + 2.1, y + 0.9, 2.5};
    } else if (atom.element == 1) {  // The hydrogen is at the nitrogen, or at OXT.
      atom.position = name == "HXT" ? glm::dvec3(x + 4.2, y + 2.1, 0.95) : glm::dvec3(x, y + 0.6, beside += 0.4);
    } else {
      const bool is_oxygen = name[0] == 'O';
      atom.position = {x + (is_oxygen      ? 4.2
                            : name == "CD" ? 0.0
                                           : 2.1),
                       y + (name == "OXT" || name.back() == '2' ? 2.1 : -2.1), 0.0};
    }
    structure.atoms.push_back(atom);
  }
}

TEST(Lipophilicity, EndsOfChainsAndDisulphidesAreFoundByPlaceAndBonds) {
  Structure s;
  constexpr double kNext = 6.3;
  add_residue(s, "A", "GLY", 0, "N CA C O");
  add_residue(s, "A", "CYS", kNext, "N CA C O CB SG");
  add_residue(s, "A", "ALA", 2 * kNext, "N CA C O OXT CB");
  add_residue(s, "B", "PRO", 0, "N CA C O CB CG CD");
  add_residue(s, "B", "CYS", kNext, "N CA C O CB SG");  // the chain is not complete: no OXT
  s.atoms.back().position = {kNext + 2.1, 2.9, 2.5};    // 2 Å from that of chain A
  add_residue(s, "C", "ALA", 0, "N H1 H2 H3 CA C O CB");
  add_residue(s, "C", "CYS", kNext, "N H CA C O OXT HXT CB SG");
  add_residue(s, "D", "ACE", 0, "CH3 C O");
  add_residue(s, "D", "ALA", kNext, "N CA C OC1 OC2 CB");
  add_residue(s, "E", "ALA", 0, "N H CA C O CB");  // Its hydrogen shows that the residue before it is missing.
  add_residue(s, "E", "ALA", 3 * kNext, "N CA C OT1 OT2 CB");  // The residue follows a gap.
  const std::vector<double> found = lipophilicities(s);
  const auto value = [&](std::uint32_t residue, const char* name) {
    for (std::size_t a = 0; a < s.atoms.size(); ++a)
      if (s.atoms[a].residue == residue && s.atoms[a].name == name) return found[a];
    return std::nan("");
  };
  // RDKit 2026.09, as above: [NH3+], [NH2+] of proline, amides; O- and O of carboxylates in halves; COOH; CSSC.
  const struct {
    std::uint32_t residue;
    const char* name;
    double value;
  } wanted[] = {{0, "N", -1.3074},  {0, "O", -0.1526},    {1, "N", -0.4954},   {1, "SG", 0.6482},   {2, "N", -0.4954},
                {2, "O", -0.7393},  {2, "OXT", -0.7393},  {3, "N", -1.5216},   {4, "N", -0.4954},   {4, "O", -0.1526},
                {4, "SG", 0.6482},  {5, "N", -1.3074},    {6, "N", -0.4954},   {6, "O", -0.1526},   {6, "OXT", 0.0087},
                {6, "SG", 0.3805},  {8, "N", -0.4954},    {8, "OC1", -0.7393}, {8, "OC2", -0.7393}, {9, "N", -0.4954},
                {10, "N", -0.4954}, {10, "OT1", -0.7393}, {10, "OT2", -0.7393}};
  for (const auto& [residue, name, number] : wanted)
    EXPECT_NEAR(value(residue, name), number, 1e-9) << residue << " " << name;
  EXPECT_TRUE(std::isnan(value(7, "C")));
  const auto paint = lipophilicity_paint(s, scheme("lipophilicity"));
  const glm::dvec3 at_end = s.atoms[0].position - glm::dvec3(2, 0, 0);
  EXPECT_LT(paint->value(at_end, {1, 0, 0}), -0.1) << "an ammonium is hydrophilic";
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
