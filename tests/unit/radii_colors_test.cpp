// SPDX-License-Identifier: BSD-3-Clause
// Radii and colours: table entries against their sources, and every scheme on a small molecule.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/molecule/color_schemes.h"
#include "core/molecule/radii.h"

namespace meniscus {
namespace {

TEST(Radii, AreThoseOfTheTwoPapers) {
  const std::pair<int, double> bondi[] = {{1, 1.20},  {6, 1.70},  {7, 1.55},  {8, 1.52},  {9, 1.47},  {15, 1.80},
                                          {16, 1.80}, {17, 1.75}, {30, 1.39}, {34, 1.90}, {35, 1.85}, {36, 2.02},
                                          {53, 1.98}, {54, 2.16}, {78, 1.72}, {80, 1.55}, {82, 2.02}, {92, 1.86}};
  for (const auto& [element, radius] : bondi) {
    EXPECT_EQ(bondi_radius(static_cast<std::uint8_t>(element)).radius, radius) << element;
    EXPECT_EQ(bondi_radius(static_cast<std::uint8_t>(element)).source, RadiusSource::bondi) << element;
  }
  EXPECT_EQ(bondi_radius(20).radius, 2.31);
  EXPECT_EQ(bondi_radius(20).source, RadiusSource::mantina);
  for (const int element : {0, 26, 25, 118, 200}) {
    EXPECT_EQ(bondi_radius(static_cast<std::uint8_t>(element)).radius, 2.0) << element;
    EXPECT_EQ(bondi_radius(static_cast<std::uint8_t>(element)).source, RadiusSource::none) << element;
  }
}

TEST(Radii, SymbolsFollowAtomicNumbers) {
  EXPECT_STREQ(element_symbol(0), "X");
  EXPECT_STREQ(element_symbol(26), "Fe");
  EXPECT_STREQ(element_symbol(54), "Xe");
  EXPECT_STREQ(element_symbol(86), "Rn");
  EXPECT_STREQ(element_symbol(118), "Og");
  EXPECT_STREQ(element_symbol(119), "X");
}

TEST(Radii, ElementsWithoutSourceAreNamed) {
  Structure structure;
  for (const int element : {6, 26, 26, 42}) structure.atoms.emplace_back().element = static_cast<std::uint8_t>(element);
  assign_bondi_radii(structure);
  EXPECT_EQ(structure.atoms[0].radius, 1.7);
  EXPECT_EQ(structure.atoms[1].radius, 2.0);
  EXPECT_EQ(structure.radii_set, "bondi");
  ASSERT_EQ(structure.report.warnings.size(), 1u);
  EXPECT_EQ(structure.report.warnings[0],
            "no published van der Waals radius for Fe (2 atoms), Mo (1 atom); 2.0 Å is used");
}

Structure four_atoms() {
  Structure structure;
  structure.file = "four";
  const char* chains[] = {"A", "A", "B", "A"};
  const char* residues[] = {"ASP", "LYS", "GLY", "XXX"};
  const float b_factors[] = {10.0f, 20.0f, 30.0f, std::numeric_limits<float>::quiet_NaN()};
  for (int n = 0; n < 4; ++n) {
    Atom& atom = structure.atoms.emplace_back();
    atom.chain = chains[n];
    atom.residue_name = residues[n];
    atom.b_factor = b_factors[n];
    atom.element = static_cast<std::uint8_t>(6 + n % 3);
  }
  return structure;
}

Coloring colored(const char* scheme, const Structure& structure = four_atoms()) {
  return color_atoms(structure, parse_color_scheme(scheme).value());
}

TEST(Colors, WordsAreReadStrictly) {
  for (const char* good : {"element", "chain", "residue", "bfactor", "kind", "atom", "#00ff7F"}) {
    EXPECT_TRUE(parse_color_scheme(good)) << good;
  }
  for (const char* bad : {"", "Element", "#fff", "#00ff7g", "#-0ff7f", "#00ff7f0", "red"}) {
    EXPECT_FALSE(parse_color_scheme(bad)) << bad;
  }
  EXPECT_EQ((parse_color_range("-1:2.5")), (std::array<double, 2>{-1.0, 2.5}));
  for (const char* bad : {"", ":", "1", "1:1", "2:1", "1:nan", "1:2:3", "a:b"})
    EXPECT_FALSE(parse_color_range(bad)) << bad;
}

TEST(Colors, FixedAndElement) {
  EXPECT_EQ(colored("#ff0080").atom[2], glm::vec3(1.0f, 0.0f, 128.0f / 255.0f));
  const Coloring element = colored("element");
  EXPECT_EQ(element.atom[0], element.atom[3]);
  EXPECT_EQ(element.atom[2], element_color(8));
  EXPECT_FALSE(element.kind);
}

TEST(Colors, ChainsInOrderOfAppearanceDiffer) {
  const Coloring chain = colored("chain");
  EXPECT_EQ(chain.atom[0], chain.atom[1]);
  EXPECT_EQ(chain.atom[0], chain.atom[3]);
  EXPECT_NE(chain.atom[0], chain.atom[2]);
  Structure many;
  for (int n = 0; n < 21; ++n) many.atoms.emplace_back().chain = std::to_string(n);
  const Coloring colors = colored("chain", many);
  for (std::size_t i = 0; i < 21; ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(colors.atom[i], colors.atom[j]) << i << " " << j;
  }
}

TEST(Colors, ResiduesByChemistry) {
  const Coloring residue = colored("residue");
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(residue.atom[i], residue.atom[j]);
  }
}

TEST(Colors, BFactorsSpanTheMapAndMissingOnesAreGrey) {
  const Coloring automatic = colored("bfactor");
  EXPECT_EQ(automatic.atom[0], viridis(0.0));
  EXPECT_EQ(automatic.atom[1], viridis(0.5));
  EXPECT_EQ(automatic.atom[2], viridis(1.0));
  EXPECT_EQ(automatic.atom[3], kMissingValueColor);
  ColorScheme scheme = parse_color_scheme("bfactor").value();
  scheme.range = {{20.0, 40.0}};
  const Coloring ranged = color_atoms(four_atoms(), scheme);
  EXPECT_EQ(ranged.atom[0], viridis(0.0));  // below the range: its end
  EXPECT_EQ(ranged.atom[2], viridis(0.5));
  Structure none = four_atoms();
  for (Atom& atom : none.atoms) atom.b_factor = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(color_atoms(none, scheme), InputError);
}

TEST(Colors, ViridisIsTheKnownMap) {
  const auto near = [](glm::vec3 color, double r, double g, double b) {
    return std::abs(color.x - r) < 0.006 && std::abs(color.y - g) < 0.006 && std::abs(color.z - b) < 0.006;
  };
  EXPECT_TRUE(near(viridis(0.0), 0.267004, 0.004874, 0.329415));
  EXPECT_TRUE(near(viridis(1.0), 0.993248, 0.906157, 0.143936));
  EXPECT_TRUE(near(viridis(128.0 / 255.0), 0.127568, 0.566949, 0.550556));
  EXPECT_EQ(viridis(-3.0), viridis(0.0));
  EXPECT_EQ(viridis(7.0), viridis(1.0));
}

TEST(Colors, KindAndOrder) {
  const Coloring kind = colored("kind");
  ASSERT_TRUE(kind.kind);
  EXPECT_NE((*kind.kind)[0], (*kind.kind)[1]);
  EXPECT_EQ(kind.atom.size(), 4u);
  const Coloring order = colored("atom");
  EXPECT_EQ(order.atom.front(), viridis(0.0));
  EXPECT_EQ(order.atom.back(), viridis(1.0));
}

}  // namespace
}  // namespace meniscus
