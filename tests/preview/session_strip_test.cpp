// SPDX-License-Identifier: BSD-3-Clause
// The strip of kept scenes: numbers on the way are those of a film, and all else comes from the nearer scene.
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/scene/cut.h"
#include "core/scene/transition.h"
#include "core/structure/formats/read_structure.h"
#include "tests/preview/session_case.h"
#include "tests/preview/two_models.h"

namespace meniscus::test {
namespace {

class StripSession : public SessionCase {
 protected:
  StripSession() { begin(read_structure(folder_.file("two.pdb", kTwoModels), {})); }
  void begin_with_two_frames() {
    ReadOptions reading;
    reading.model.all = true;
    begin(read_structure(folder_.file("two.pdb", kTwoModels), reading));
  }
};

TEST_F(StripSession, GoesFromSceneToSceneAsFilmsDo) {
  EXPECT_FALSE(apply(R"({"command":"strip","place":0})")["ok"]);
  for (const char* command :
       {R"({"command":"set","key":"surface.probe","value":1})",
        R"({"command":"add","key":"surface.clip","value":"x<3"})",
        R"({"command":"set","key":"look.ambient","value":0.2})",
        R"({"command":"set","key":"image.background","value":"#000000"})",
        R"({"command":"set","key":"surface.color","value":"element"})", R"({"command":"keep_scene"})"})
    expect_ok(command);
  const Json first = values();
  const auto first_picture = picture();
  const Camera from = session_->state().camera;
  for (const char* command :
       {R"({"command":"set","key":"surface.probe","value":2})",
        R"({"command":"set","key":"surface.clip","index":0,"value":"x<1"})",
        R"({"command":"set","key":"look.ambient","value":0.6})",
        R"({"command":"set","key":"image.background","value":"#ffffff"})",
        R"({"command":"set","key":"surface.color","value":"chain"})", R"({"command":"orbit","dx":0.3,"dy":0.1})"})
    expect_ok(command);
  const Camera to = session_->state().camera;
  EXPECT_EQ(apply(R"({"command":"keep_scene"})")["scenes"], 2);
  const Json second = values();

  for (const double place : {0.25, 0.5, 0.75}) {
    expect_ok(fmt::format(R"({{"command":"strip","place":{}}})", place));
    const double share = eased(place, Pace::smooth);
    const Json told = values();
    EXPECT_NEAR(told["surface.probe"].get<double>(), 1.0 + share, 1e-9);
    EXPECT_NEAR(told["look.ambient"].get<double>(), 0.2 + 0.4 * share, 1e-6);
    EXPECT_NEAR(parse_cut(told["surface.clip"][0].get<std::string>()).bound, 3.0 - 2.0 * share, 1e-9);
    EXPECT_EQ(told["surface.color"], (place < 0.5 ? first : second)["surface.color"]);
    EXPECT_NEAR(glm::distance(session_->state().camera.position, camera_between(from, to, share).position), 0.0, 1e-6);
  }
  expect_ok(R"({"command":"strip","place":0})");
  EXPECT_EQ(picture(), first_picture);
  expect_ok(R"({"command":"undo"})");  // the whole strip is one step
  EXPECT_EQ(values()["surface.probe"], second["surface.probe"]);

  // The film shows 0.4 s of the first scene, 2 s of the way, and 1 s of the second scene.
  expect_ok(R"({"command":"time_scene","index":0,"hold":0.4})");
  expect_ok(R"({"command":"time_scene","index":1,"hold":1})");
  expect_ok(R"({"command":"strip","place":0})");
  EXPECT_EQ(apply(R"({"command":"play","strip":true,"fps":5})")["playing"], true);
  std::vector<double> places{0.0};
  while (session_->state().playing && places.size() < 100) {
    const Json reply = apply(R"({"command":"next_frame"})");
    ASSERT_TRUE(reply["ok"]) << reply;
    places.push_back(reply["place"]);
  }
  std::vector<double> expected{0.0, 0.0};
  for (int n = 1; n <= 10; ++n) expected.push_back(n / 11.0);
  expected.insert(expected.end(), 5, 1.0);
  ASSERT_EQ(places.size(), expected.size());
  for (std::size_t n = 0; n < places.size(); ++n) EXPECT_NEAR(places[n], expected[n], 1e-12) << n;
  EXPECT_EQ(state()["fps"], 10.0) << "frames have a rate of their own";
  EXPECT_EQ(values()["surface.clip"], second["surface.clip"]);
  EXPECT_FALSE(apply(R"({"command":"strip","place":1.01})")["ok"]);
  EXPECT_FALSE(apply(R"({"command":"keep_scene","index":2})")["ok"]);
  EXPECT_EQ(apply(R"({"command":"forget_scene","index":0})")["scenes"], 1);
  EXPECT_EQ(apply(R"({"command":"play","strip":true})")["playing"], false);
}

// The next picture of the film would undo an edit while it plays.
TEST_F(StripSession, AnEditPausesTheFilm) {
  begin_with_two_frames();
  for (const char* command : {R"({"command":"keep_scene"})", R"({"command":"set","key":"surface.probe","value":2})",
                              R"({"command":"keep_scene"})"})
    expect_ok(command);
  for (const char* edit :
       {R"({"command":"set","key":"look.ambient","value":0.9})", R"({"command":"orbit","dx":0.3,"dy":0.1})",
        R"({"command":"frame","index":1})", R"({"command":"undo"})"}) {
    expect_ok(R"({"command":"strip","place":0.5})");
    expect_ok(R"({"command":"play","strip":true})");
    expect_ok(R"({"command":"next_frame"})");
    expect_ok(R"({"command":"resize","width":90,"height":60})");
    EXPECT_TRUE(session_->state().playing) << edit;
    expect_ok(edit);
    EXPECT_FALSE(session_->state().playing) << edit;
    EXPECT_EQ(state()["strip"]["playing"], false) << edit;
  }
  expect_ok(R"({"command":"play"})");
  expect_ok(R"({"command":"set","key":"look.ambient","value":0.5})");
  EXPECT_TRUE(session_->state().playing) << "frames do not change what is edited";
}

TEST_F(StripSession, ScenesKeepTheirFramesAndTimes) {
  begin_with_two_frames();
  expect_ok(R"({"command":"keep_scene"})");
  expect_ok(R"({"command":"time_scene","index":0,"hold":1.5,"transition":0})");
  expect_ok(R"({"command":"frame","index":1})");
  expect_ok(R"({"command":"keep_scene"})");
  expect_ok(R"({"command":"time_scene","index":1,"hold":3})");
  expect_ok(R"({"command":"keep_scene","index":1})");
  const Json kept = state()["strip"]["kept"];
  EXPECT_EQ(kept[0]["frame"], 0);
  EXPECT_EQ(kept[1]["frame"], 1);
  EXPECT_EQ(kept[0]["hold"], 1.5);
  EXPECT_EQ(kept[1]["hold"], 3.0);
  EXPECT_EQ(kept[1]["transition"], 0.0) << "that of the scene before it";
  EXPECT_NE(kept[0]["number"], kept[1]["number"]);
  for (const auto& [place, frame] : {std::pair(0.0, 0), std::pair(0.4, 0), std::pair(0.6, 1), std::pair(1.0, 1)}) {
    expect_ok(fmt::format(R"({{"command":"strip","place":{}}})", place));
    EXPECT_EQ(state()["frame"], frame) << place;
  }
  // The films have 1.5 s, a cut and 3 s at 25 pictures per second; one turn; two frames at 10 per second.
  const Json told = apply(R"({"command":"films","width":101,"height":60})");
  EXPECT_EQ(told["width"], 100);
  EXPECT_EQ(told["films"], Json::parse(R"([{"of":"strip","pictures":113,"seconds":4.52},
      {"of":"frames","pictures":2,"seconds":0.2},{"of":"turntable","pictures":150,"seconds":6.0}])"));
  for (const char* wrong :
       {R"({"command":"time_scene","index":2,"hold":1})", R"({"command":"time_scene","index":0,"hold":-1})",
        R"({"command":"time_scene","index":0,"transition":3601})"})
    EXPECT_FALSE(apply(wrong)["ok"]) << wrong;
  expect_ok(R"({"command":"forget_scene","index":0})");
  EXPECT_EQ(apply(R"({"command":"films"})")["films"][0]["of"], "frames");
}

}  // namespace
}  // namespace meniscus::test
