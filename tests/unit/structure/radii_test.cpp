// SPDX-License-Identifier: BSD-3-Clause
// Radii: table entries against their sources.
#include <gtest/gtest.h>

#include "core/structure/radii/assign_radii.h"
#include "core/structure/element_tables.h"
#include "core/structure/structure.h"

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
  RadiiChoice({}, "file", FileRadii::none).assign(structure);
  EXPECT_EQ(structure.atoms[0].radius, 1.7);
  EXPECT_EQ(structure.atoms[1].radius, 2.0);
  EXPECT_EQ(structure.radii_set, "bondi");
  ASSERT_EQ(structure.report.warnings.size(), 1u);
  EXPECT_EQ(structure.report.warnings[0].text,
            "no published van der Waals radius for Fe (2 atoms), Mo (1 atom); 2.0 Å is used");
}

}  // namespace
}  // namespace meniscus
