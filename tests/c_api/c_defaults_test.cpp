// SPDX-License-Identifier: BSD-3-Clause
// Defaults are the same through every door: those of the C interface are those of a scene.
#include <gtest/gtest.h>

#include "core/scene/scene.h"
#include "meniscus/meniscus.h"

namespace meniscus {
namespace {

TEST(CApiDefaults, OfPicturesAreThoseOfAScene) {
  meniscus_scene* made = nullptr;
  ASSERT_EQ(meniscus_scene_new(&made), MENISCUS_OK);
  std::int32_t width = 0, height = 0;
  EXPECT_EQ(meniscus_scene_size(made, &width, &height), MENISCUS_OK);
  meniscus_scene_release(made);
  EXPECT_EQ(glm::ivec2(width, height), Scene{}.picture.size());
}

TEST(CApiDefaults, OfMoleculesAreThoseOfAScene) {
  meniscus_read_options reading{};
  reading.size = sizeof reading;
  ASSERT_EQ(meniscus_default_read_options(&reading), MENISCUS_OK);
  const ReadOptions usual = Scene{}.molecule.reading;
  EXPECT_EQ(reading.model, usual.model.number);
  EXPECT_EQ(reading.hydrogens == MENISCUS_HYDROGENS_AUTO, usual.hydrogens == Hydrogens::automatic);
  EXPECT_EQ(reading.unknown_element == MENISCUS_UNKNOWN_HALT, usual.unknown_element == UnknownElement::halt);
  EXPECT_EQ(reading.keep_water != 0, usual.keep_water);
  EXPECT_EQ(reading.keep_ions != 0, usual.keep_ions);
  EXPECT_EQ(reading.select, nullptr);
  EXPECT_FALSE(usual.selection);
}

}  // namespace
}  // namespace meniscus
