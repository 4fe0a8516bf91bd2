// SPDX-License-Identifier: BSD-3-Clause
// Scenes: every property of scene files has a value, which is the same after it was written and read again.
#include "core/scene/scene_values.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/scene/scene_json.h"

namespace meniscus {
namespace {

using Texts = std::vector<std::string>;

/// Returns a possible value of a property that is not its default.
Texts example_of(const Property& property) {
  const std::map<std::string_view, Texts> examples{
      {"molecule.model", {"2"}},
      {"molecule.altloc", {"B"}},
      {"molecule.radii", {"protor"}},
      {"molecule.radius", {"element Zn=1.1", "resid 3=2.5"}},
      {"frames.begin", {"2.5ns"}},
      {"frames.whole", {"guess"}},
      {"frames.codec", {"vp9"}},
      {"frames.bits", {"10"}},
      {"frames.chroma", {"422"}},
      {"surface.interface", {"chain A:chain B"}},
      {"surface.probe", {"2.125"}},
      {"surface.by", {"residue"}},
      {"surface.color", {"chain", "resid 3=#ff0000:Three = 3", "name CA=bfactor"}},
      {"surface.map", {"magma"}},
      {"surface.color_range", {"-1.5:2.25"}},
      {"surface.missing_color", {"#102030"}},
      {"surface.opacity", {"0.25", "chain A=0.5"}},
      {"surface.clip", {"x<20.125", "depth>0.5", "before resid 7"}},
      {"surface.cap_color", {"#ff8000"}},
      {"look.light", {"-1,0.25,3"}},
      {"look.silhouettes", {"0.5pt"}},
      {"look.outer_lines", {"2.5"}},
      {"look.inner_lines", {"1.25"}},
      {"look.part_lines", {"0.2mm"}},
      {"look.patch_lines", {"1pt"}},
      {"look.patch_line_color", {"#102030"}},
      {"image.dpi", {"150"}},
      {"image.size", {"640x480"}},
      {"image.width", {"85mm"}},
      {"image.height", {"3.5in"}},
      {"image.margin", {"3mm"}},
      {"image.background", {"#102030"}},
      {"image.extent", {"visible"}},
      {"camera.view", {"-symmetry"}},
      {"camera.turn", {"y90", "x-30.5"}},
      {"legend.size", {"8pt"}},
      {"legend.names", {"A=Alpha", "B=Beta"}},
      {"annotations.letter_size", {"7pt"}},
      {"annotations.label_size", {"20"}},
      {"annotations.scale_bar_size", {"2mm"}},
      {"annotations.panel_size", {"10pt"}},
      {"annotations.letter_color", {"#ffffff"}},
      {"annotations.scale_bar", {"12.5"}},
      {"annotations.labels", {"resid 48=Ser 48", "name CA=x=y"}},
      {"mesh.unit", {"nanometer"}},
  };
  if (const auto found = examples.find(property.key); found != examples.end()) return found->second;
  if (property.type == ValueType::flag) return {"true"};
  if (property.type == ValueType::word)
    for (const std::string& word : words_of(property))
      if (word != property.initial && !(property.initial.empty() && word == words_of(property).front())) return {word};
  if (property.type == ValueType::word) return {words_of(property).back()};
  if (property.type == ValueType::count) return {std::to_string(static_cast<int>(property.lowest) + 3)};
  if (property.type == ValueType::number) {
    const double middle = std::min(property.highest, std::max(property.lowest, 0.0) * 1.5 + 0.375);
    return {property.has_range() ? std::to_string(middle) : "0.375"};
  }
  return {"resid 7"};  // selections, and texts that may be anything
}

std::vector<const Property*> scene_properties() {
  std::vector<const Property*> chosen;
  for (const Property* property : properties())
    if (property->has(in_scene)) chosen.push_back(property);
  return chosen;
}

// A property without a member would be dropped from scene files without a word.
TEST(SceneValues, AreThereForEveryPropertyOfSceneFiles) {
  for (const Property* property : scene_properties()) EXPECT_TRUE(is_scene_value(*property)) << property->key;
}

TEST(SceneValues, ComeBackAsTheyWereWritten) {
  for (const Property* property : scene_properties()) {
    SCOPED_TRACE(std::string(property->key));
    Scene scene, again;
    EXPECT_TRUE(value_texts(scene, *property).empty());
    const Texts example = example_of(*property);
    set_value(scene, *property, example);
    if (property->section() == "image" || !scene.lengths.empty()) complete(scene);
    const Texts written = value_texts(scene, *property);
    if (property->key == "mesh.unit") {  // another word for a scale
      EXPECT_EQ(value_texts(scene, property_of("mesh.scale")), Texts{"0.1"});
      continue;
    }
    ASSERT_FALSE(written.empty());
    if (example.size() > 1) {
      EXPECT_NE(written.front(), written.back());
    }
    set_value(again, *property, written);
    if (property->section() == "image" || !again.lengths.empty()) complete(again);
    EXPECT_EQ(value_texts(again, *property), written);
    EXPECT_TRUE(scene == again);
    EXPECT_FALSE(scene == Scene{});
  }
}

TEST(SceneValues, OfAFileAreThoseOfTheScene) {
  Scene scene;
  scene.molecule.file = "1tii.pdb";
  for (const Property* property : scene_properties()) {
    const Texts example = example_of(*property);
    const bool is_alone = property->key == "mesh.unit" || property->key == "surface.interface" ||
                          property->section() == "output" || property->key == "image.size";
    if (!is_alone && property->key != "molecule.file") set_value(scene, *property, example);
  }
  const std::string text = scene_text(scene, ".");
  Scene again;
  for (const SceneSetting& setting : parse_scene(text, "scene.json"))
    set_value(again, *setting.property, setting.texts);
  EXPECT_EQ(scene_text(again, "."), text);
  EXPECT_TRUE(scene == again);
}

TEST(SceneValues, OfPresetsLieUnderTheOthers) {
  std::vector<std::string> words;
  for (const Preset& preset : kPresets) words.emplace_back(preset.word);
  EXPECT_EQ(words, words_of(property_of("look.preset")));
  const std::map<std::string_view, Texts> own{{"look.shadows", {"0.75"}},
                                              {"surface.color", {"red", "chain A=#00ff00"}},
                                              {"surface.opacity", {"0.25"}},
                                              {"figure.sticks", {"resid 9"}},
                                              {"surface.clip", {"x<20"}}};
  for (const Preset& preset : kPresets) {
    SCOPED_TRACE(std::string(preset.word));
    Scene first, last;
    set_value(first, property_of("look.preset"), Texts{std::string(preset.word)});
    for (const auto& [key, texts] : own)
      for (Scene* const scene : {&first, &last}) set_value(*scene, property_of(key), texts);
    set_value(last, property_of("look.preset"), Texts{std::string(preset.word)});
    complete(first);
    complete(last);
    EXPECT_TRUE(first == last);
    for (const auto& [key, texts] : own) {
      const Texts all = value_texts(first, property_of(key));
      EXPECT_EQ(all.back(), texts.back()) << key;
      if (key == "surface.color") {
        EXPECT_EQ(parse_color_scheme(all.front())->fixed, parse_color_scheme("red")->fixed);
      }
      if (key == "surface.clip") {
        EXPECT_EQ(all, texts);
      }
    }
    Scene again = first;
    complete(again);
    EXPECT_TRUE(again == first) << "a completed scene changes";
    EXPECT_TRUE(preset_of(first.look.preset).settings.empty());
  }
}

// A moving camera or a camera of its own has no aim.
TEST(SceneValues, OfAPresetLeaveACameraAsItIs) {
  for (const char* const key : {"camera.from", "camera.path"}) {
    Scene scene;
    set_value(scene, property_of("look.preset"), Texts{"pocket"});
    set_value(scene, property_of(key), Texts{"camera.json"});
    complete(scene);
    EXPECT_FALSE(scene.picture.zoom_to);
    EXPECT_FALSE(scene.picture.direction);
    EXPECT_EQ(scene.figure.cuts.size(), 1u);
  }
}

// The numbers of a file are a scheme themselves.
TEST(SceneValues, OfAPresetLeaveNumbersTheirColors) {
  Scene scene;
  set_value(scene, property_of("look.preset"), Texts{"goodsell"});
  set_value(scene, property_of("surface.color_by_file"), Texts{"numbers.txt"});
  complete(scene);
  EXPECT_EQ(scene.molecule.color.by, ColorScheme::By::file);
  EXPECT_EQ(scene.molecule.surface.kind, SurfaceKind::vdw);
}

TEST(SceneValues, OnPaperFollowTheResolution) {
  Scene scene;
  set_value(scene, property_of("image.width"), Texts{"25.4mm"});
  set_value(scene, property_of("look.silhouettes"), Texts{"2.4pt"});
  complete(scene);
  EXPECT_EQ(scene.picture.dots_per_inch, 300.0);
  EXPECT_EQ(scene.picture.size(), glm::ivec2(300, 225));
  EXPECT_EQ(scene.look.silhouettes, 10.0f);
  set_value(scene, property_of("image.dpi"), Texts{"100"});
  complete(scene);
  EXPECT_EQ(scene.picture.size(), glm::ivec2(100, 75));
  EXPECT_NEAR(*scene.look.silhouettes, 10.0f / 3.0f, 1e-6f);
  scene.look.silhouettes = 3.0f;  // a preview's slider: pixels from now on
  EXPECT_EQ(value_texts(scene, property_of("look.silhouettes")), Texts{"3"});
}

// 7.2 points are 30 pixels at 300 dots an inch, wider than lines are, and 10 at 100.
TEST(SceneValues, OnPaperAreMeasuredWhenTheResolutionIsKnown) {
  Scene scene;
  set_value(scene, property_of("look.silhouettes"), Texts{"7.2pt"});
  set_value(scene, property_of("image.dpi"), Texts{"100"});
  complete(scene);
  EXPECT_EQ(scene.look.silhouettes, 10.0f);
  set_value(scene, property_of("image.dpi"), Texts{"300"});
  EXPECT_THROW(complete(scene), ValueError);
}

TEST(SceneValues, SayWhatIsWrongAndNotWhere) {
  const auto fault = [](std::string_view key, const std::string& text) {
    Scene scene;
    try {
      set_value(scene, property_of(key), Texts{text});
    } catch (const ValueError& error) {
      EXPECT_EQ(error.key(), key);
      EXPECT_EQ(std::string(error.what()).find("--"), std::string::npos) << error.what();
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(fault("look.ambient", "2"), "'2' is not a number from 0 to 1");
  EXPECT_EQ(fault("surface.kind", "msms"), "'msms' is not one of ses, sas, vdw");
  EXPECT_EQ(fault("image.size", "12"), "'12' is not WIDTHxHEIGHT in pixels, 1 to 65535 each, such as 1920x1080");
  EXPECT_EQ(fault("frames.bits", "9"), "'9' is not one of 8, 10");
}

TEST(SceneValues, OfColoursAreCheckedTogether) {
  const auto fault_of = [](std::initializer_list<std::pair<std::string_view, Texts>> values) {
    Scene scene;
    for (const auto& [key, texts] : values) set_value(scene, property_of(key), texts);
    try {
      complete(scene);
    } catch (const ValueError& error) {
      return std::string(error.key());
    }
    return std::string();
  };
  EXPECT_EQ(fault_of({{"surface.color", {"chain"}}, {"surface.map", {"magma"}}}), "surface.map");
  EXPECT_EQ(fault_of({{"surface.color", {"bfactor"}}, {"surface.map", {"magma"}}}), "");
  EXPECT_EQ(fault_of({{"surface.color", {"file"}}}), "surface.color");
  EXPECT_EQ(fault_of({{"surface.color_by_file", {"n.txt"}}}), "");
  EXPECT_EQ(fault_of({{"surface.color_map_file", {"n.dx"}}}), "surface.color_map_file");
}

}  // namespace
}  // namespace meniscus
