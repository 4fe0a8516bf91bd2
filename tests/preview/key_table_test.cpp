// SPDX-License-Identifier: BSD-3-Clause
// The keys of a preview, as the page sends them.
#include "app/preview/key_table.h"

#include <cctype>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace meniscus::test {
namespace {

using Json = nlohmann::json;

const Json kState = Json::parse(R"({"camera": {"projection": "perspective"}, "probe_radius": 1.4, "frame": 0,
  "frames": 3, "playing": false, "patch_kinds": false, "color": {"scheme": "element"},
  "look": {"background": "#ffffff"}})");

Json setting(const char* key, const Json& value) { return {{"command", "set"}, {"key", key}, {"value", value}}; }

Json typed(const char* key, const Json& state) { return key_meaning(key, state).command.value_or(Json()); }

TEST(Keys, MeanWhatTheHelpSays) {
  EXPECT_EQ(typed("r", kState), Json({{"command", "reset_view"}}));
  EXPECT_EQ(typed("o", kState), setting("camera.projection", "orthographic"));
  EXPECT_EQ(typed("1", kState), setting("surface.color", {"element"}));
  EXPECT_EQ(typed("k", kState), setting("surface.color", "kind"));
  Json painted = kState;
  painted["color"]["rules"] = {"ligand=#ff0000"};
  EXPECT_EQ(typed("2", painted), setting("surface.color", {"chain", "ligand=#ff0000"})) << "rules stay";
  EXPECT_EQ(typed(" ", kState), Json({{"command", "play"}}));
  EXPECT_EQ(typed("x", kState), Json());
  Json shaded = kState;
  EXPECT_EQ(typed("a", shaded), setting("look.ambient_occlusion", 1.0));
  shaded["look"]["ambient_occlusion"] = 1.0;
  EXPECT_EQ(typed("a", shaded), setting("look.ambient_occlusion", 0.0));
  EXPECT_EQ(typed("l", shaded), setting("look.silhouettes", 1.5));
  EXPECT_EQ(typed(".", kState), Json({{"command", "frame"}, {"index", 1}}));
  EXPECT_EQ(typed(",", kState), Json({{"command", "frame"}, {"index", 2}}));
  EXPECT_GT(typed("ArrowRight", kState)["dx"], 0.0);
  EXPECT_LT(typed("ArrowLeft", kState)["dx"], 0.0);
  EXPECT_LT(typed("ArrowUp", kState)["dy"], 0.0);
  EXPECT_GT(typed("+", kState)["factor"], 1.0);
  EXPECT_EQ(typed("z", kState), Json()) << "there is nothing to undo";
  Json changed = kState;
  changed["undo"] = changed["redo"] = 1;
  EXPECT_EQ(typed("z", changed), Json({{"command", "undo"}}));
  EXPECT_EQ(typed("y", changed), Json({{"command", "redo"}}));
  Json single = kState;
  single["frames"] = 1;
  EXPECT_EQ(typed(",", single), Json());
  EXPECT_EQ(typed(" ", single), Json());
}

TEST(Keys, AllThatTheHelpNamesMeanSomething) {
  Json state = kState;
  state["undo"] = state["redo"] = 1;
  state["legend"] = {{"on", false}};
  int count = 0;
  for (const KeyHelp& row : key_help()) {
    std::istringstream words(row.keys);
    for (std::string word; words >> word;) {
      if (word == "space") word = " ";
      if (word.size() > 1) continue;  // of the mouse, or "..."
      const KeyMeaning meaning = key_meaning(word, state);
      EXPECT_TRUE(meaning.command || meaning.action) << row.keys << ": " << word;
      std::string great = word;
      great[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(great[0])));
      EXPECT_EQ(key_meaning(great, state).command, meaning.command) << "with caps lock, " << word;
      EXPECT_EQ(key_meaning(great, state).action, meaning.action) << "with caps lock, " << word;
      ++count;
    }
  }
  EXPECT_EQ(count, 12);
}

TEST(Keys, ProbeStepsStayOnTenths) {
  Json state = kState;
  for (int n = 0; n < 30; ++n) state["probe_radius"] = typed("[", state)["value"];
  EXPECT_EQ(state["probe_radius"], 0.0);
  for (int n = 1; n <= 17; ++n) {
    state["probe_radius"] = typed("]", state)["value"];
    EXPECT_EQ(state["probe_radius"].get<double>(), n / 10.0);
  }
}

}  // namespace
}  // namespace meniscus::test
