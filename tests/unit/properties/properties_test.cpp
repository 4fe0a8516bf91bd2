// SPDX-License-Identifier: BSD-3-Clause
// The table of properties: keys and words that fit together, and ranges that are those of the code behind them.
#include <cctype>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/base/constants.h"
#include "core/base/error.h"
#include "core/base/text_file.h"
#include "core/mesh/triangle_mesh.h"
#include "core/properties/properties.h"
#include "core/render/look.h"
#include "exporters/mesh_files/mesh_formats.h"

namespace meniscus {
namespace {

TEST(Properties, KeysAreUniqueAndNameASection) {
  std::set<std::string_view> keys;
  for (const Property* property : properties()) {
    EXPECT_TRUE(keys.insert(property->key).second) << property->key << " stands twice";
    EXPECT_NE(property->key.find('.'), std::string_view::npos) << property->key;
  }
  EXPECT_GT(keys.size(), 150u);
  EXPECT_THROW(property_of("look.no_such_thing"), std::logic_error);
}

TEST(Properties, SceneKeysOfOneSectionStandTogether) {
  std::set<std::string_view> ended;
  std::string_view section;
  for (const Property* property : properties()) {
    if (!property->has(in_scene) || property->section() == section) continue;
    EXPECT_FALSE(ended.contains(property->section())) << property->key << " comes after another section began";
    ended.insert(section);
    section = property->section();
  }
}

TEST(Properties, HelpIsAPhraseUnderAHeading) {
  for (const Property* property : properties()) {
    EXPECT_FALSE(property->help.empty()) << property->key;
    EXPECT_FALSE(property->heading.empty()) << property->key;
    EXPECT_NE(property->help.back(), '.') << property->key;
    // The words of a value may come first, as in "ses: solvent-excluded".
    const bool begins_with_word =
        property->words.starts_with(property->help.substr(0, property->help.find_first_of(" :,")));
    const bool is_capital = std::isupper(static_cast<unsigned char>(property->help.front())) != 0;
    EXPECT_TRUE(is_capital || begins_with_word || property->help.starts_with("auto")) << property->key;
    EXPECT_EQ(property->value.empty(), property->type == ValueType::flag || !property->option.starts_with('-'))
        << property->key;
  }
}

TEST(Properties, WordsHaveTheDefaultAmongThem) {
  for (const Property* property : properties()) {
    if (property->type != ValueType::word) continue;
    const std::vector<std::string> words = words_of(*property);
    EXPECT_GT(words.size(), 1u) << property->key;
    if (property->initial.empty()) continue;
    EXPECT_NE(std::ranges::find(words, property->initial), words.end()) << property->key;
  }
}

TEST(Properties, RangesAreThoseOfTheCode) {
  const auto expect = [](std::string_view key, double lowest, double highest) {
    EXPECT_EQ(property_of(key).lowest, lowest) << key;
    EXPECT_EQ(property_of(key).highest, highest) << key;
  };
  for (const char* lines :
       {"look.silhouettes", "look.outer_lines", "look.inner_lines", "look.part_lines", "look.patch_lines"})
    expect(lines, 0.0, kWidestSilhouette);
  expect("mesh.tolerance", kSmallestTolerance, kLargestTolerance);
  expect("pockets.tolerance", kSmallestTolerance, kLargestTolerance);
  expect("mesh.density", kSmallestDensity, kLargestDensity);
  expect("mesh.scale", kSmallestFileScale, kLargestFileScale);
  double probe = 0.0;
  EXPECT_TRUE(parse_number(std::string(property_of("surface.probe").initial), probe));
  EXPECT_EQ(probe, kUsualProbe);
}

// A number of the look that had no property, or whose property is not one of scenes, bundles and the preview, would be
// missing there without a word.
TEST(Properties, EveryNumberOfALookIsEverywhere) {
  EXPECT_EQ(look_numbers().size(), 16u);
  for (const LookNumber& number : look_numbers()) {
    const Property& property = property_of(number.key);
    EXPECT_TRUE(property.has_range() && property.has(in_scene) && property.has(in_bundle) && property.has(live))
        << number.key;
    LookRequest asked;
    *number.requested(asked) = 0.5f;
    const Look look = look_of(asked, {640, 480}, {}, Hues::free);
    if (number.in) {
      Look changed = look;
      EXPECT_EQ(number.in(changed), 0.5f) << number.key;
    }
  }
}

TEST(Properties, BundlesHaveNoPropertyThatWritesAFile) {
  for (const Property* property : properties()) {
    if (!property->has(in_bundle)) continue;
    EXPECT_NE(property->type, ValueType::new_file) << property->key;
  }
}

}  // namespace
}  // namespace meniscus
