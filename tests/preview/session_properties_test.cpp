// SPDX-License-Identifier: BSD-3-Clause
// The command "set": every property that the preview changes gets another value, which the state and the saved scene
// have, and which undo takes back; a bad value changes nothing.
#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "core/properties/properties.h"
#include "core/scene/scene_json.h"
#include "tests/preview/session_case.h"

namespace meniscus::test {
namespace {

class PreviewProperties : public PeptideSession {
 protected:
  PreviewProperties() : PeptideSession(parse_selection("polymer"), true) {
    expect_ok(R"({"command":"resize","width":200,"height":150})");
    expect_ok(R"({"command":"set","key":"figure.sticks","value":"ligand"})");
    expect_ok(R"({"command":"set","key":"surface.color","value":"bfactor"})");
  }

  Json set(const std::string& key, const Json& value) {
    return session_->apply({{"command", "set"}, {"key", key}, {"value", value}});
  }
  Json choices() { return apply(R"({"command":"choices"})")["properties"]; }

  /// Returns the texts of a property in the scene that pictures contain; empty if it has its default.
  std::vector<std::string> saved(const std::string& key) {
    const std::string text = apply(R"({"command":"scene"})")["text"];
    std::vector<std::string> texts;
    for (const SceneSetting& setting : parse_scene(text, "scene"))
      if (setting.property->key == key) texts.insert(texts.end(), setting.texts.begin(), setting.texts.end());
    return texts;
  }
};

/// For each property, a value that it does not have at first, as "values" shows it, and one that is refused.
const std::map<std::string, std::pair<Json, Json>>& examples() {
  static const std::map<std::string, std::pair<Json, Json>> all{
      {"surface.shown", {false, "no"}},
      {"surface.kind", {"sas", "ms"}},
      {"surface.probe", {2.5, -1}},
      {"surface.show", {"name CA C", "chain ("}},
      {"surface.patches", {"element C", "chain ("}},
      {"surface.min_patch", {25, -1}},
      {"surface.color", {{"chain", "name CA=#ff0000"}, "rainbows"}},
      {"surface.map", {"magma", "jet"}},
      {"surface.color_range", {"5:80", "9:1"}},
      {"surface.missing_color", {"#123456", "greenish"}},
      {"surface.color_title", {"Mobility", {1}}},
      {"surface.color_unit", {"nm", {1}}},
      {"surface.opacity", {{0.5, "name O=0.25"}, 1.5}},
      {"surface.film_opacity", {true, 1}},
      {"surface.clip", {{"x<1.5"}, "x=1"}},
      {"surface.clip_all", {true, "yes"}},
      {"surface.cap_color", {"#00ff00", "greenish"}},
      {"surface.cap_hatching", {0.5, -1}},
      {"figure.sticks", {{"ligand", "name O"}, "chain ("}},
      {"figure.balls", {{"ligand"}, "chain ("}},
      {"figure.spheres", {{"resn HOH"}, "chain Q"}},
      {"figure.tube", {{"polymer"}, "chain ("}},
      {"figure.bases", {Json::array(), "chain ("}},
      {"figure.glycans", {Json::array(), "chain ("}},
      {"figure.object",
       {{{{"representation", "spheres"}, {"selection", "resn HOH"}, {"color", "#00ff00"}}},
        {{"selection", "ligand"}, {"colour", "red"}}}},
      {"shapes.bare", {true, 3}},
      {"shapes.stick_radius", {0.4, 0}},
      {"shapes.tube_radius", {0.5, 0}},
      {"look.preset", {"flat", "loud"}},
      {"look.light", {"1,0,0.5", "1,2"}},
      {"look.light_strength", {1.5, 11}},
      {"look.ambient", {0.375, 2}},
      {"look.roughness", {0.375, 2}},
      {"look.specular", {0.375, 2}},
      {"look.shininess", {20, 0}},
      {"look.ambient_occlusion", {0.375, 2}},
      {"look.ambient_occlusion_radius", {10, 0}},
      {"look.ambient_occlusion_rays", {16, -1}},
      {"look.shadows", {0.375, 2}},
      {"look.shadow_softness", {8, 46}},
      {"look.silhouettes", {2, 17}},
      {"look.outer_lines", {3, 17}},
      {"look.inner_lines", {"0.5pt", 17}},
      {"look.part_lines", {2, "2ft"}},
      {"look.patch_lines", {3, -1}},
      {"look.patch_line_color", {"#ffff00", "greenish"}},
      {"look.depth_cue", {0.375, 2}},
      {"look.linear_alpha", {true, "yes"}},
      {"camera.projection", {"orthographic", "fish"}},
      {"image.size", {"120x90", "auto"}},
      {"image.width", {"85mm", "85 miles"}},
      {"image.height", {"200px", "0mm"}},
      {"image.dpi", {150, 0}},
      {"image.samples", {2, 0}},
      {"image.background", {"#336699", "greenish"}},
      {"legend.shown", {true, 1}},
      {"legend.title", {"Mobility", {1}}},
      {"legend.size", {12, 2}},
      {"legend.names", {{"A=Alpha"}, {{1}}}},
      {"legend.place", {"below", "left"}},
      {"annotations.panel", {"b", {1}}},
      {"annotations.title", {"Toxin", {1}}},
      {"annotations.scale_bar", {5, "long"}},
      {"annotations.labels", {{"name CA=here"}, "chain Q=here"}},
      {"annotations.lengths", {false, 1}},
      {"annotations.letter_size", {14, 2}},
      {"annotations.font", {"DejaVu Sans", {1}}},
      {"annotations.letter_color", {"#ffffff", "greenish"}},
  };
  return all;
}

TEST_F(PreviewProperties, AllThatAreOfferedCanBeSet) {
  std::size_t count = 0;
  for (const Json& choice : choices()) {
    const std::string key = choice["key"];
    SCOPED_TRACE(key);
    ASSERT_TRUE(examples().contains(key));
    const auto& [good, bad] = examples().at(key);
    const Json before = values();
    const Json refused = set(key, bad);
    EXPECT_FALSE(refused["ok"]);
    const std::string error = refused.value("error", "");
    EXPECT_TRUE(error.starts_with("set: ")) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    EXPECT_EQ(values(), before);
    ++count;
    if (good == Json::array()) continue;  // the molecule has no such atoms
    ASSERT_NE(before[key], good);
    expect_ok(R"({"command":"end_step"})");
    const Json reply = set(key, good);
    ASSERT_TRUE(reply["ok"]) << reply;
    EXPECT_EQ(values()[key], good);
    const Property& property = property_of(key);
    if (key == "figure.object") {
      EXPECT_EQ(Json::parse(saved(key).at(0)), good[0]);
    } else if (property.section() != "camera") {  // pictures contain the camera itself
      EXPECT_EQ(saved(key), texts_of_json(property, nlohmann::ordered_json(good)));
    }
    const Json after = values();
    expect_ok(R"({"command":"undo"})");
    EXPECT_EQ(values(), before);
    expect_ok(R"({"command":"redo"})");
    EXPECT_EQ(values(), after);
    expect_ok(R"({"command":"undo"})");
    // The first value is set, and null, which means the default. The width of all lines is also that of each kind, and
    // a colour is written in one way.
    EXPECT_TRUE(set(key, before[key])["ok"]);
    if (key != "look.silhouettes" && key != "look.patch_line_color") {
      EXPECT_EQ(values(), before);
    }
    EXPECT_TRUE(set(key, Json())["ok"]);
    expect_ok(R"({"command":"undo"})");
    EXPECT_EQ(values(), before);
  }
  EXPECT_EQ(count, examples().size());
}

TEST_F(PreviewProperties, ErrorsNameKeyValueAndLimits) {
  const std::vector<std::pair<std::pair<const char*, Json>, const char*>> kRefused{
      {{"look.ambient", 2}, "set: look.ambient: '2' is not a number from 0 to 1"},
      {{"look.ambient", true}, "set: look.ambient: 'true' is neither a text nor a number"},
      {{"surface.kind", "ms"}, "set: surface.kind: 'ms' is not one of ses, sas, vdw"},
      {{"surface.shown", 1}, "set: surface.shown: '1' is neither true nor false"},
      {{"surface.prob", 1},
       "set: \"key\" is 'surface.prob', which is not a property that the preview changes; did you "
       "mean surface.probe?"},
      {{"molecule.file", "a.pdb"}, "set: \"key\" is 'molecule.file', which is not a property that the preview changes"},
      {{"surface.clip", Json(17, "x<1")}, "set: surface.clip: at most 16 entries are allowed, not 17"},
      {{"look.silhouettes", 17}, "set: look.silhouettes: '17' makes 17 pixels; a line has 0 to 16"},
  };
  for (const auto& [setting, error] : kRefused)
    EXPECT_EQ(set(setting.first, setting.second).value("error", ""), error) << setting.first;
  EXPECT_TRUE(set("surface.color", "chain")["ok"]);
  EXPECT_EQ(set("surface.map", "magma").value("error", ""),
            "set: surface.map: is for colours by a number, not 'chain'");
  EXPECT_TRUE(set("surface.kind", "vdw")["ok"]);
  EXPECT_NE(set("surface.probe", 2).value("error", "").find("has no probe"), std::string::npos);
}

TEST_F(PreviewProperties, SlidersOfOnePropertyAreOneStep) {
  expect_ok(R"({"command":"end_step"})");
  const int before = state()["undo"];
  for (const double radius : {1.5, 1.6, 1.7}) EXPECT_TRUE(set("surface.probe", radius)["ok"]);
  EXPECT_EQ(state()["undo"], before + 1);
  EXPECT_TRUE(set("look.ambient", 0.5)["ok"]);
  EXPECT_EQ(state()["undo"], before + 2) << "another property";
  EXPECT_TRUE(set("surface.film_opacity", true)["ok"]);
  EXPECT_TRUE(set("surface.film_opacity", false)["ok"]);
  EXPECT_EQ(state()["undo"], before + 4) << "each switch is a step";
}

TEST_F(PreviewProperties, AnotherSchemeHasAScaleOfItsOwnAndARuleKeepsIt) {
  EXPECT_TRUE(set("surface.map", "magma")["ok"]);
  EXPECT_TRUE(set("surface.color", {"bfactor", "name CA=#ff0000"})["ok"]);
  EXPECT_EQ(values()["surface.map"], "magma");
  EXPECT_TRUE(set("surface.color", "occupancy")["ok"]);
  EXPECT_TRUE(values()["surface.map"].is_null());
  expect_ok(R"({"command":"undo"})");
  EXPECT_EQ(values()["surface.map"], "magma");
}

TEST_F(PreviewProperties, AreOfferedWithWhatControlsNeed) {
  std::map<std::string, Json> offered;
  for (const Json& choice : choices()) {
    const std::string help = choice["help"], label = choice["label"];
    EXPECT_EQ(help.find_first_of("@_"), std::string::npos) << help;
    EXPECT_EQ(help.find("--"), std::string::npos) << help;
    EXPECT_EQ(label.find_first_of("@_."), std::string::npos) << label;
    offered[choice["key"]] = choice;
  }
  EXPECT_EQ(offered["surface.kind"]["words"], Json({"ses", "sas", "vdw"}));
  EXPECT_EQ(offered["surface.probe"]["unit"], "Å");
  EXPECT_EQ(offered["surface.probe"]["type"], "number");
  EXPECT_EQ(offered["image.samples"]["label"], "Rays per pixel");
  EXPECT_EQ(offered["look.shadow_softness"]["highest"], 45.0);
  EXPECT_EQ(offered["look.silhouettes"]["type"], "length");
  EXPECT_EQ(offered["image.background"]["type"], "color");
  EXPECT_EQ(offered["surface.show"]["type"], "selection");
  EXPECT_EQ(offered["figure.sticks"]["is_list"], true);
}

}  // namespace
}  // namespace meniscus::test
