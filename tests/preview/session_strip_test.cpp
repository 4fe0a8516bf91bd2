// SPDX-License-Identifier: BSD-3-Clause
// The strip of kept scenes: on the way numbers are those of a film, all else is that of the nearer scene.
#include <string>
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
};

TEST_F(StripSession, GoesFromSceneToSceneAsFilmsDo) {
  EXPECT_FALSE(apply(R"({"command":"strip","place":0})")["ok"]);
  for (const char* command :
       {R"({"command":"set","key":"surface.probe","value":1})", R"({"command":"cut","plane":"x<3"})",
        R"({"command":"set","key":"look.ambient","value":0.2})",
        R"({"command":"set","key":"image.background","value":"#000000"})",
        R"({"command":"set","key":"surface.color","value":"element"})", R"({"command":"keep_scene"})"})
    expect_ok(command);
  const Json first = state();
  const auto first_picture = picture();
  const Camera from = session_->state().camera;
  for (const char* command :
       {R"({"command":"set","key":"surface.probe","value":2})", R"({"command":"cut","plane":"x<1","index":0})",
        R"({"command":"set","key":"look.ambient","value":0.6})",
        R"({"command":"set","key":"image.background","value":"#ffffff"})",
        R"({"command":"set","key":"surface.color","value":"chain"})", R"({"command":"orbit","dx":0.3,"dy":0.1})"})
    expect_ok(command);
  const Camera to = session_->state().camera;
  EXPECT_EQ(apply(R"({"command":"keep_scene"})")["scenes"], 2);
  const Json second = state();

  for (const double place : {0.25, 0.5, 0.75}) {
    expect_ok(fmt::format(R"({{"command":"strip","place":{}}})", place));
    const double share = eased(place, Pace::smooth);
    const Json told = state();
    EXPECT_NEAR(told["probe_radius"].get<double>(), 1.0 + share, 1e-9);
    EXPECT_NEAR(told["look"]["ambient"].get<double>(), 0.2 + 0.4 * share, 1e-6);
    EXPECT_NEAR(parse_cut(told["cuts"][0].get<std::string>()).bound, 3.0 - 2.0 * share, 1e-9);
    EXPECT_EQ(told["color"], place < 0.5 ? first["color"] : second["color"]);
    EXPECT_NEAR(glm::distance(session_->state().camera.position, camera_between(from, to, share).position), 0.0, 1e-6);
  }
  expect_ok(R"({"command":"strip","place":0})");
  EXPECT_EQ(picture(), first_picture);
  expect_ok(R"({"command":"undo"})");  // all of the strip is a step
  EXPECT_EQ(state()["probe_radius"], second["probe_radius"]);

  expect_ok(R"({"command":"strip","place":0})");
  EXPECT_EQ(apply(R"({"command":"play","strip":true,"fps":5})")["playing"], true);
  double place = 0.0;
  int pictures = 0;
  for (; session_->state().playing && pictures < 100; ++pictures) {
    const Json reply = apply(R"({"command":"next_frame"})");
    ASSERT_TRUE(reply["ok"]) << reply;
    EXPECT_GT(reply["place"].get<double>(), place);
    place = reply["place"];
  }
  EXPECT_EQ(pictures, 10);  // 2 s
  EXPECT_EQ(place, 1.0);
  EXPECT_EQ(state()["cuts"], second["cuts"]);
  EXPECT_FALSE(apply(R"({"command":"strip","place":1.01})")["ok"]);
  EXPECT_FALSE(apply(R"({"command":"keep_scene","index":2})")["ok"]);
  EXPECT_EQ(apply(R"({"command":"forget_scene","index":0})")["scenes"], 1);
  EXPECT_EQ(apply(R"({"command":"play","strip":true})")["playing"], false);
}

}  // namespace
}  // namespace meniscus::test
