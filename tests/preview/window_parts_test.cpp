// SPDX-License-Identifier: BSD-3-Clause
// Mouse, keys and clocks of the window, without a window.
#include <cctype>
#include <cmath>
#include <sstream>
#include <string>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "app/preview/command_json.h"
#include "app/preview/window/gestures.h"
#include "app/preview/window/gui.h"
#include "app/preview/window/latency.h"
#include "app/preview/window/panel.h"
#include "app/preview/window/session_link.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;
using Kind = InputEvent::Kind;

constexpr glm::ivec2 kSize{400, 200};

/// A hand on a mouse over a picture of kSize.
class Hand {
 public:
  Hand& press(MouseButton button, bool shift = false) { return act(Kind::press, button, shift); }
  Hand& release(MouseButton button) { return act(Kind::release, button, false); }
  Hand& to(double x, double y) {
    place_ = {x, y};
    return act(Kind::move, MouseButton::left, false);
  }
  Hand& wheel(double notches) {
    InputEvent event{Kind::scroll, place_};
    event.scroll = notches;
    gestures_.take(event, kSize, elsewhere, commands);
    return *this;
  }
  Hand& wait(double seconds) {
    time_ += seconds;
    return *this;
  }
  std::optional<Click> click() const { return gestures_.click(); }
  bool dragging() const { return gestures_.dragging(); }

  bool elsewhere = false;
  std::vector<Json> commands;

 private:
  Hand& act(Kind kind, MouseButton button, bool shift) {
    InputEvent event{kind, place_, button};
    event.shift = shift;
    event.time = time_ += 0.01;
    gestures_.take(event, kSize, elsewhere, commands);
    return *this;
  }

  Gestures gestures_;
  glm::dvec2 place_{0.0};
  double time_ = 0.0;
};

TEST(Gestures, ALeftDragTurnsByHeightsOfThePicture) {
  Hand hand;
  hand.to(100, 100).press(MouseButton::left).to(120, 100).to(120, 60);
  ASSERT_EQ(hand.commands.size(), 1u);
  EXPECT_EQ(hand.commands[0]["command"], "orbit");
  EXPECT_DOUBLE_EQ(hand.commands[0]["dx"], 0.1);
  EXPECT_DOUBLE_EQ(hand.commands[0]["dy"], -0.2);
  hand.commands.clear();
  hand.to(500, -60);  // beyond the picture: still held
  EXPECT_DOUBLE_EQ(hand.commands.at(0)["dx"], 1.9);
  hand.release(MouseButton::left).to(10, 10);
  EXPECT_EQ(hand.commands.size(), 1u);  // no inertia, nothing held
}

TEST(Gestures, OtherDragsPan) {
  for (const auto& [button, shift] : {std::pair(MouseButton::right, false), std::pair(MouseButton::middle, false),
                                      std::pair(MouseButton::left, true)}) {
    Hand hand;
    hand.to(0, 0).press(button, shift).to(0, 50);
    ASSERT_EQ(hand.commands.size(), 1u);
    EXPECT_EQ(hand.commands[0], Json({{"command", "pan"}, {"dx", 0.0}, {"dy", 0.25}}));
    hand.release(MouseButton::left == button ? MouseButton::right : MouseButton::left);
    EXPECT_TRUE(hand.dragging()) << "another button's release ended the drag";
  }
}

TEST(Gestures, AShakyClickIsNoDrag) {
  Hand hand;
  hand.to(50, 50).press(MouseButton::left).to(52, 51).release(MouseButton::left);
  EXPECT_TRUE(hand.commands.empty());
  ASSERT_TRUE(hand.click());
  EXPECT_EQ(hand.click()->position, glm::dvec2(52, 51));
  EXPECT_FALSE(hand.click()->twice);
  hand.to(53, 51);
  EXPECT_FALSE(hand.click());
  hand.press(MouseButton::left).release(MouseButton::left);
  EXPECT_TRUE(hand.click()->twice);
  hand.press(MouseButton::left).release(MouseButton::left);
  EXPECT_FALSE(hand.click()->twice) << "the third click begins anew";
  hand.wait(1.0).press(MouseButton::left).release(MouseButton::left);
  EXPECT_FALSE(hand.click()->twice);
  hand.to(60, 60).press(MouseButton::left).to(90, 60).release(MouseButton::left);
  EXPECT_FALSE(hand.click());
}

TEST(Gestures, TheWheelZoomsAndNotchesBackUndoIt) {
  Hand hand;
  hand.wheel(1).wheel(2);
  ASSERT_EQ(hand.commands.size(), 1u);
  EXPECT_NEAR(hand.commands[0]["factor"].get<double>(), std::pow(1.1, 3), 1e-12);
  hand.wheel(-3);
  EXPECT_NEAR(hand.commands[0]["factor"].get<double>(), 1.0, 1e-12);
}

TEST(Gestures, WhatHappensOverThePanelIsNotTheirs) {
  Hand hand;
  hand.elsewhere = true;
  hand.to(0, 0).press(MouseButton::left).to(90, 90).wheel(1).release(MouseButton::left);
  EXPECT_TRUE(hand.commands.empty());
  EXPECT_FALSE(hand.click());
}

const Json kState = Json::parse(R"({"camera": {"projection": "perspective"}, "probe_radius": 1.4, "frame": 0,
  "frames": 3, "playing": false, "patch_kinds": false, "color": {"scheme": "element"},
  "look": {"background": "#ffffff"}})");

Json typed(char32_t letter, const Json& state) {
  InputEvent event;
  event.kind = Kind::text;
  event.letter = letter;
  return event_meaning(event, state).command.value_or(Json());
}

Json pressed(int key, const Json& state) {
  InputEvent event;
  event.kind = Kind::key;
  event.key = key;
  return event_meaning(event, state).command.value_or(Json());
}

TEST(Keys, MeanWhatTheHelpSays) {
  EXPECT_EQ(typed(U'r', kState), Json({{"command", "reset_view"}}));
  EXPECT_EQ(typed(U'o', kState), Json({{"command", "projection"}, {"projection", "orthographic"}}));
  EXPECT_EQ(typed(U'1', kState), Json({{"command", "color"}, {"scheme", "element"}}));
  EXPECT_EQ(typed(U'2', kState), Json({{"command", "color"}, {"scheme", "chain"}}));
  EXPECT_EQ(typed(U'k', kState), Json({{"command", "patch_kinds"}, {"on", true}}));
  EXPECT_EQ(typed(U' ', kState), Json({{"command", "play"}}));
  EXPECT_EQ(typed(U'x', kState), Json());
  Json shaded = kState;
  predict(typed(U'a', shaded), shaded);
  EXPECT_EQ(shaded["look"]["ambient_occlusion"], 1.0);
  EXPECT_EQ(typed(U'a', shaded), Json({{"command", "look"}, {"ambient_occlusion", 0.0}}));
  EXPECT_EQ(typed(U'l', shaded), Json({{"command", "look"}, {"silhouettes", 1.5}}));
  EXPECT_EQ(typed(U'.', kState), Json({{"command", "frame"}, {"index", 1}}));
  EXPECT_EQ(typed(U',', kState), Json({{"command", "frame"}, {"index", 2}}));
  EXPECT_GT(pressed(GLFW_KEY_RIGHT, kState)["dx"], 0.0);
  EXPECT_LT(pressed(GLFW_KEY_LEFT, kState)["dx"], 0.0);
  EXPECT_LT(pressed(GLFW_KEY_UP, kState)["dy"], 0.0);
  EXPECT_GT(typed(U'+', kState)["factor"], 1.0);
  EXPECT_EQ(typed(U'z', kState), Json()) << "there is nothing to undo";
  Json changed = kState;
  changed["undo"] = changed["redo"] = 1;
  EXPECT_EQ(typed(U'z', changed), Json({{"command", "undo"}}));
  EXPECT_EQ(typed(U'y', changed), Json({{"command", "redo"}}));
  Json single = kState;
  single["frames"] = 1;
  EXPECT_EQ(typed(U',', single), Json());
  EXPECT_EQ(typed(U' ', single), Json());
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
      if (word == "Esc") word = "Escape";
      if (word.size() > 1 && word != "Escape") continue;  // of the mouse, or "..."
      const KeyMeaning meaning = key_meaning(word, state);
      EXPECT_TRUE(meaning.command || meaning.action) << row.keys << ": " << word;
      std::string great = word;
      if (great.size() == 1) great[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(great[0])));
      EXPECT_EQ(key_meaning(great, state).command, meaning.command) << "with caps lock, " << word;
      EXPECT_EQ(key_meaning(great, state).action, meaning.action) << "with caps lock, " << word;
      ++count;
    }
  }
  EXPECT_GT(count, 20);
}

TEST(Keys, ProbeStepsStayOnTenths) {
  Json state = kState;
  for (int n = 0; n < 30; ++n) predict(typed(U'[', state), state);
  EXPECT_EQ(state["probe_radius"], 0.0);
  for (int n = 1; n <= 17; ++n) {
    predict(typed(U']', state), state);
    EXPECT_EQ(state["probe_radius"].get<double>(), n / 10.0);
  }
}

TEST(Foresight, TwoQuickKeysAreTwoSwitches) {
  Json state = kState;
  predict(typed(U'o', state), state);
  predict(typed(U'o', state), state);
  EXPECT_EQ(state, kState);
  predict({{"command", "look"}, {"background", "black"}}, state);
  EXPECT_EQ(state["look"]["background"], "black");
  predict({{"command", "orbit"}, {"dx", 1}, {"dy", 1}}, state);
  EXPECT_EQ(state["camera"], kState["camera"]);
}

TEST(Latency, CountsPicturesFromTheirOldestMovement) {
  LatencyMeter meter;
  EXPECT_EQ(meter.result().pictures, 0u);
  meter.sent(1, {{"command", "orbit"}}, 1.000);
  meter.sent(2, {{"command", "orbit"}}, 1.010);
  meter.sent(3, {{"command", "state"}}, 1.011);
  meter.shown(2, 1.030);
  meter.shown(3, 1.900);  // nothing moved
  EXPECT_EQ(meter.result().pictures, 1u);
  EXPECT_NEAR(meter.result().median_ms, 30.0, 1e-6);
  for (int n = 0; n < 19; ++n) {
    meter.sent(10 + n, {{"command", "probe"}}, 2.0 + n);
    meter.shown(10 + n, 2.0 + n + (n == 0 ? 0.5 : 0.1));
  }
  EXPECT_NEAR(meter.result().median_ms, 100.0, 1e-6);
  EXPECT_NEAR(meter.result().p95_ms, 100.0, 1e-6);
  meter.sent(40, {{"command", "zoom"}}, 50.0);
  meter.shown(40, 50.6);
  EXPECT_NEAR(meter.result().p95_ms, 500.0, 1e-6);
}

TEST(Latency, CountsRedrawsWhileAMovementWaits) {
  LatencyMeter meter;
  meter.shown(0, 0.5);
  meter.sent(1, {{"command", "orbit"}}, 1.0);
  meter.shown(0, 1.25);
  meter.sent(2, {{"command", "orbit"}}, 1.3);
  meter.shown(1, 1.5);
  meter.shown(2, 2.0);
  meter.shown(2, 7.0);
  meter.sent(3, {{"command", "orbit"}}, 8.0);
  meter.shown(2, 8.25);
  EXPECT_EQ(meter.result().pictures, 2u);
  EXPECT_EQ(meter.result().redraws, 4u);
  EXPECT_DOUBLE_EQ(meter.result().seconds, 1.25);
}

// A mouse that rests must not have a surface computed, and neither it nor a click may stop the pictures.
TEST(AtomQuestion, WaitsForNothing) {
  const Json state{{"width", 300}, {"height", 200}};
  EXPECT_EQ(atom_question({12.7, 250.0}, false, state),
            Json::parse(R"({"command":"pick","x":12,"y":199,"wait":false,"area":false})"));
  EXPECT_EQ(atom_question({-3.0, 5.0}, true, state),
            Json::parse(R"({"command":"pick","x":0,"y":5,"wait":false,"area":true})"));
}

TEST(Panel, TellsPicturesASecondOnlyWhileTheyMove) {
  const Json stats{{"width", 640}, {"height", 480}, {"frame_milliseconds", 4000.0}, {"fps", 0.25}};
  EXPECT_EQ(timing_line(stats, true), "640 \xc3\x97 480: 4000.0 ms");
  EXPECT_EQ(timing_line(stats, false), "640 \xc3\x97 480, draft: 4000.0 ms, 0.2 fps");
}

TEST(Panel, SaysFaultsWithoutWordsOfThePrograms) {
  EXPECT_EQ(sentence_of("probe: it must be a number", "probe"), "it must be a number");
  EXPECT_EQ(sentence_of("probe: it must be a number", "look"), "probe: it must be a number");
}

TEST(Panel, TellsWhatWasPicked) {
  const Json pick{{"hit", true},      {"name", "CA"},         {"element", "C"},
                  {"residue", "ALA"}, {"residue_number", 12}, {"insertion_code", ""},
                  {"chain", "A"},     {"kind", "toroidal"},   {"exposed_area", 1.234}};
  EXPECT_EQ(pick_lines(pick), (std::array<std::string, 4>{"atom CA (C)", "residue ALA 12, chain A", "toroidal patch",
                                                          "exposed area 1.23 \xc3\x85\xc2\xb2"}));
  EXPECT_EQ(pick_lines({{"hit", false}})[0], "");
}

}  // namespace
}  // namespace meniscus
