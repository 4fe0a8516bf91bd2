// SPDX-License-Identifier: BSD-3-Clause
// The C interface has the defaults of a scene.
#include <array>

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

/// Compares the fields that a macro initializes with the defaults of the library.
template <typename Struct, typename... Fields>
void expect_defaults(Struct begun, meniscus_status (*fill)(Struct*), Fields... fields) {
  Struct filled{};
  filled.size = sizeof filled;
  ASSERT_EQ(fill(&filled), MENISCUS_OK);
  const auto compare = [&](auto field) { EXPECT_EQ(begun.*field, filled.*field); };
  (compare(fields), ...);
}

TEST(CApiDefaults, AreWhatTheMacrosBeginStructsWith) {
  using Options = meniscus_options;
  expect_defaults<Options>(MENISCUS_OPTIONS_INIT, meniscus_default_options, &Options::size, &Options::probe_radius,
                           &Options::kind, &Options::device, &Options::threads, &Options::verify);
  using Reading = meniscus_read_options;
  expect_defaults<Reading>(MENISCUS_READ_OPTIONS_INIT, meniscus_default_read_options, &Reading::size, &Reading::select,
                           &Reading::assembly, &Reading::radii, &Reading::radii_files, &Reading::radius,
                           &Reading::radii_file_count, &Reading::radius_count, &Reading::model, &Reading::hydrogens,
                           &Reading::unknown_element, &Reading::keep_water, &Reading::keep_ions, &Reading::reserved);
  const Reading reading = MENISCUS_READ_OPTIONS_INIT;
  EXPECT_STREQ(reading.altloc, "best");
  using Pockets = meniscus_pocket_options;
  expect_defaults<Pockets>(MENISCUS_POCKET_OPTIONS_INIT, meniscus_default_pocket_options, &Pockets::size,
                           &Pockets::large_probe_radius, &Pockets::trim, &Pockets::min_volume,
                           &Pockets::mouth_tolerance);
  using Mesh = meniscus_mesh_options;
  expect_defaults<Mesh>(MENISCUS_MESH_OPTIONS_INIT, meniscus_default_mesh_options, &Mesh::size, &Mesh::method,
                        &Mesh::split_colors, &Mesh::tolerance, &Mesh::density);
  using File = meniscus_mesh_file;
  expect_defaults<File>(MENISCUS_MESH_FILE_INIT, meniscus_default_mesh_file, &File::size, &File::format,
                        &File::atom_colors, &File::scale, &File::replace);
  const File file = MENISCUS_MESH_FILE_INIT;
  EXPECT_STREQ(file.attributes, "usual");
  EXPECT_EQ(std::to_array(file.color), (std::array{0.75f, 0.82f, 0.9f}));
}

}  // namespace
}  // namespace meniscus
