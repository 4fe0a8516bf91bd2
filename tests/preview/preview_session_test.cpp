// SPDX-License-Identifier: BSD-3-Clause
// Commands of a preview session: their replies, their changes, and errors that change nothing.
#include "app/preview/session.h"

#include <chrono>
#include <memory>
#include <regex>
#include <thread>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/gpu/egl_context.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/structure/formats/read_structure.h"
#include "core/surface/compute_surface.h"
#include "core/surface/measure.h"
#include "tests/preview/two_models.h"
#include "tests/support/run_program.h"

namespace meniscus::test {
namespace {

using Json = nlohmann::json;

/// A session on the CPU or on GL.
class PreviewSessionTest : public ::testing::TestWithParam<const char*> {
 protected:
  PreviewSessionTest() {
    ReadOptions reading;
    reading.model.all = true;
    PreviewState view;
    view.size = {80, 60};
    if (std::string(GetParam()) == "gl") context_.emplace();
    session_ = std::make_unique<PreviewSession>(
        renderer(), read_structure(folder_.file("two.pdb", kTwoModels), reading), view, std::nullopt, folder_.path());
  }

  std::unique_ptr<PreviewRenderer> renderer() {
    return context_ ? make_gl_preview_renderer() : make_cpu_preview_renderer();
  }
  Json apply(const std::string& command) { return session_->apply(Json::parse(command)); }
  Json state() { return apply(R"({"command":"state"})"); }
  void expect_ok(const std::string& command) {
    const Json reply = apply(command);
    EXPECT_TRUE(reply["ok"]) << command << " -> " << reply;
  }

  TemporaryFolder folder_;
  std::optional<EglContext> context_;
  std::unique_ptr<PreviewSession> session_;
};

TEST_P(PreviewSessionTest, BadCommandsAreAnsweredAndChangeNothing) {
  const Json before = state();
  for (const char* command : {
           R"(7)",
           R"([])",
           R"({})",
           R"({"command":3})",
           R"({"command":"fly"})",
           R"({"command":"orbit","dx":1})",
           R"({"command":"orbit","dx":"a","dy":0})",
           R"({"command":"orbit","dx":1e9,"dy":0})",
           R"({"command":"orbit","dx":0,"dy":0,"dz":0})",
           R"({"command":"set","key":"surface.clip","index":0,"value":"x<1"})",
           R"({"command":"add","key":"surface.probe","value":2})",
           R"({"command":"add","key":"surface.clip","value":null})",
           R"({"command":"add","key":"surface.clip","value":["x<1","x>0"]})",
           R"({"command":"zoom_to","selection":"chain Z"})",
           R"({"command":"zoom_to","selection":"chain ("})",
           R"({"command":"camera","camera":{"position":[0,0,0]}})",
           R"({"command":"set","key":"camera.projection","value":"fish"})",
           R"({"command":"set","key":"surface.probe","value":-1})",
           R"({"command":"set","key":"surface.probe","value":101})",
           R"({"command":"set","key":"surface.probe","value":1e-09})",
           R"({"command":"set","key":"surface.color","value":"rainbows"})",
           R"({"command":"set","key":"surface.color","value":"component"})",
           R"({"command":"set","key":"surface.color","value":"file"})",
           R"({"command":"set","key":"surface.color","value":"charge"})",
           R"({"command":"set","key":"surface.map","value":"viridis"})",
           R"({"command":"set","key":"surface.map","value":"jet"})",
           R"({"command":"set","key":"image.background","value":"#12"})",
           R"({"command":"set","key":"look.glow","value":1})",
           R"({"command":"set","key":"look.ambient_occlusion","value":1.5})",
           R"({"command":"set","key":"look.silhouettes","value":-1})",
           R"({"command":"set","key":"look.light","value":"0,0,0"})",
           R"({"command":"set","key":"look.light","value":"1,2"})",
           R"({"command":"set","key":"look.light","value":[1,2,"3"]})",
           R"({"command":"set","key":"look.silhouettes","value":17})",
           R"({"command":"set","key":"look.depth_cue","value":2})",
           R"({"command":"frame","index":2})",
           R"({"command":"frame","index":0.5})",
           R"({"command":"resize","width":80,"height":100000})",
           R"({"command":"pick","x":80,"y":0})",
           R"({"command":"export","format":"png","path":"../x.png"})",
           R"({"command":"export","format":"png","path":".x.png"})",
           R"({"command":"export","format":"stl","path":"x.stl"})",
           R"({"command":"export","format":"png","path":"x.gif"})",
           R"({"command":"play","fps":0})",
           R"({"command":"add","key":"surface.color","value":"name O=component"})",
           R"({"command":"set","key":"surface.show","value":"chain Z"})",
       }) {
    const Json reply = apply(command);
    EXPECT_FALSE(reply["ok"]) << command;
    const std::string error = reply.value("error", "");
    EXPECT_GT(error.size(), 10u) << command;
    EXPECT_EQ(error.find('\n'), std::string::npos) << command;
    const Json parsed = Json::parse(command, nullptr, false);
    const Json named = parsed.is_object() && parsed.contains("command") ? parsed["command"] : Json();
    const std::string word = named.is_string() ? named.get<std::string>() : "";
    static const std::regex kAnyWord("^[a-z_]+: ");
    EXPECT_TRUE(error.starts_with(word + ": ") || !std::regex_search(error, kAnyWord)) << command << error;
  }
  EXPECT_EQ(state(), before);
  EXPECT_EQ(folder_.entries(), std::vector<std::string>{"two.pdb"});
}

TEST_P(PreviewSessionTest, EveryModelIsAFrame) {
  EXPECT_EQ(state()["frames"], 2);
  session_->render(Quality::full);
  const auto first = session_->rgba();
  expect_ok(R"({"command":"frame","index":1})");
  EXPECT_FALSE(session_->is_drawn(Quality::full));
  session_->render(Quality::full);
  EXPECT_NE(session_->rgba(), first);
  EXPECT_EQ(apply(R"({"command":"next_frame"})")["frame"], 0);
  session_->render(Quality::full);
  EXPECT_EQ(session_->rgba(), first);
}

TEST_P(PreviewSessionTest, PicturesCanBeGivenUpBetweenSamples) {
  ASSERT_TRUE(session_->render(Quality::draft));
  const auto draft = session_->rgba();
  expect_ok(R"({"command":"set","key":"image.samples","value":4})");
  int asked = 0;
  EXPECT_FALSE(session_->render(Quality::full, [&] { return ++asked == 2; }));
  EXPECT_EQ(asked, 2);
  EXPECT_FALSE(session_->is_drawn(Quality::full));
  EXPECT_EQ(session_->rgba(), draft);
  ASSERT_TRUE(session_->render(Quality::full, [] { return false; }));
  const auto full = session_->rgba();
  expect_ok(R"({"command":"set","key":"image.samples","value":4})");
  ASSERT_TRUE(session_->render(Quality::full));
  EXPECT_EQ(session_->rgba(), full);
}

TEST_P(PreviewSessionTest, DraftsAreHalfTheSize) {
  session_->render(Quality::draft);
  EXPECT_EQ(session_->picture_size(), glm::ivec2(40, 30));
  EXPECT_TRUE(session_->is_drawn(Quality::draft));
  EXPECT_FALSE(session_->is_drawn(Quality::full));
  session_->render(Quality::full);
  EXPECT_EQ(session_->picture_size(), glm::ivec2(80, 60));
  EXPECT_EQ(session_->rgba().size(), 80u * 60 * 4);
  EXPECT_GT(apply(R"({"command":"stats"})")["fps"], 0.0);
}

// Five spheres pass through one point; with a probe of 0.5 Å only grown radii separate them. The arcs of a view close
// without that.
TEST_P(PreviewSessionTest, StatsTellByHowMuchRadiiGrew) {
  session_->render(Quality::full);
  EXPECT_EQ(apply(R"({"command":"stats"})")["radii_grown_by"], 0.0);
  PreviewState view;
  view.size = {80, 60};
  session_ = std::make_unique<PreviewSession>(renderer(), read_structure(test_file("corpus/one-point-4239.xyzr"), {}),
                                              view, std::nullopt, folder_.path());
  expect_ok(R"({"command":"set","key":"surface.probe","value":0.5})");
  session_->render(Quality::full);
  const double grown_by = apply(R"({"command":"stats"})")["radii_grown_by"];
  EXPECT_EQ(grown_by > 0.0, std::string(GetParam()) == "cpu");
  EXPECT_LT(grown_by, 1e-5);
}

TEST_P(PreviewSessionTest, APickNamesTheAtomAndItsExactArea) {
  expect_ok(R"({"command":"zoom_to","selection":"name O"})");
  const Json reply = apply(R"({"command":"pick","x":40,"y":30})");
  ASSERT_TRUE(reply["hit"]) << reply;
  EXPECT_EQ(reply["name"], "O");
  EXPECT_EQ(reply["element"], "O");
  EXPECT_EQ(reply["chain"], "B");
  EXPECT_EQ(reply["residue_number"], 2);
  EXPECT_EQ(reply["kind"], "convex");
  std::vector<Ball> balls = balls_of(session_->structure());
  balls.resize(4);
  EXPECT_EQ(reply["exposed_area"].get<double>(), atom_areas(compute_surface_cpu(balls, 1.4)).surface[3]);
  const glm::dvec3 position{reply["position"][0], reply["position"][1], reply["position"][2]};
  EXPECT_NEAR(glm::length(position - balls[3].center), balls[3].radius, 1e-4);
  expect_ok(R"({"command":"reset_view"})");
  EXPECT_FALSE(apply(R"({"command":"pick","x":0,"y":0})")["hit"]);
}

TEST_P(PreviewSessionTest, AreasAreThoseOfTheKindOfSurface) {
  std::vector<Ball> balls = balls_of(session_->structure());
  balls.resize(4);
  const auto area = [&](double probe) { return atom_areas(compute_surface_cpu(balls, probe)).surface[3]; };
  const auto told = [&] {
    expect_ok(R"({"command":"zoom_to","selection":"name O"})");
    const Json reply = apply(R"({"command":"pick","x":40,"y":30})");
    EXPECT_EQ(reply["name"], "O");
    return reply["exposed_area"].get<double>();
  };
  const double excluded = area(1.4), touched = area(0.0);
  for (Ball& ball : balls) ball.radius += 1.4;
  const double accessible = area(0.0);
  EXPECT_EQ(told(), excluded);
  expect_ok(R"({"command":"set","key":"surface.kind","value":"sas"})");
  EXPECT_EQ(told(), accessible);
  expect_ok(R"({"command":"set","key":"surface.kind","value":"vdw"})");
  EXPECT_EQ(told(), touched);
  EXPECT_NE(apply(R"({"command":"set","key":"surface.probe","value":1})").value("error", "").find("has no probe"),
            std::string::npos);
  expect_ok(R"({"command":"set","key":"surface.kind","value":"sas"})");
  EXPECT_EQ(told(), accessible);
  expect_ok(R"({"command":"set","key":"surface.kind","value":"ses"})");
  EXPECT_EQ(told(), excluded);
}

TEST_P(PreviewSessionTest, APickDoesNotPassForTheFullPicture) {
  session_->render(Quality::full);
  const auto picture = session_->rgba();
  expect_ok(R"({"command":"pick","x":40,"y":30})");
  EXPECT_TRUE(session_->is_drawn(Quality::full)) << "nothing had to be drawn";
  const Json camera = state()["camera"];
  expect_ok(R"({"command":"orbit","dx":0.3,"dy":0})");
  expect_ok(R"({"command":"pick","x":40,"y":30})");
  EXPECT_TRUE(session_->is_drawn(Quality::plain));
  EXPECT_FALSE(session_->is_drawn(Quality::full));
  session_->apply({{"command", "camera"}, {"camera", camera}});
  session_->render(Quality::full);
  EXPECT_EQ(session_->rgba(), picture);
}

TEST_P(PreviewSessionTest, EverythingStaysInViewUntilTheCameraMoves) {
  expect_ok(R"({"command":"resize","width":40,"height":120})");
  const Json narrow = state()["camera"];
  expect_ok(R"({"command":"resize","width":80,"height":60})");
  EXPECT_NE(state()["camera"], narrow);
  expect_ok(R"({"command":"orbit","dx":0.1,"dy":0})");
  const Json moved = state()["camera"];
  expect_ok(R"({"command":"resize","width":40,"height":120})");
  EXPECT_EQ(state()["camera"], moved);
  expect_ok(R"({"command":"reset_view"})");
  EXPECT_EQ(state()["camera"], narrow);
}

TEST_P(PreviewSessionTest, AnAreaThatIsNotWaitedForComesLater) {
  const Json first = apply(R"({"command":"pick","x":40,"y":30,"wait":false})");
  ASSERT_TRUE(first["hit"]);
  EXPECT_TRUE(first["exposed_area"].is_null());
  const Json later = apply(R"({"command":"pick","x":40,"y":30})");
  EXPECT_GT(later["exposed_area"], 0.0);
  EXPECT_EQ(apply(R"({"command":"pick","x":40,"y":30,"wait":false})"), later);
}

// A resting mouse begins no surface that no one has requested; only a click does.
TEST_P(PreviewSessionTest, AMouseAtRestHasNoSurfaceComputedForIt) {
  const auto pick = [&](bool clicked) {
    return session_->apply({{"command", "pick"}, {"x", 40}, {"y", 30}, {"wait", false}, {"area", clicked}});
  };
  const auto told_within_half_a_second = [&](bool clicked) {
    for (int n = 0; n < 50; ++n, std::this_thread::sleep_for(std::chrono::milliseconds(10)))
      if (pick(clicked)["exposed_area"].is_number()) return true;
    return false;
  };
  const bool has_surface = !context_;  // the CPU draws the complete surface, so its areas are cheap
  const Json first = pick(false);
  ASSERT_TRUE(first["hit"]);
  EXPECT_EQ(first["area_follows"], has_surface);
  EXPECT_EQ(told_within_half_a_second(false), has_surface);
  EXPECT_TRUE(told_within_half_a_second(true));
  EXPECT_TRUE(told_within_half_a_second(false)) << "what is known is told";
  EXPECT_EQ(pick(true)["area_follows"], false);
}

TEST_P(PreviewSessionTest, KindsOfPatchAreAScheme) {
  expect_ok(R"({"command":"set","key":"surface.color","value":"#ff0000"})");
  session_->render(Quality::full);
  const auto red = session_->rgba();
  expect_ok(R"({"command":"set","key":"surface.color","value":"kind"})");
  EXPECT_EQ(state()["values"]["surface.color"], Json::array({"kind"}));
  session_->render(Quality::full);
  EXPECT_NE(session_->rgba(), red);
  expect_ok(R"({"command":"undo"})");
  session_->render(Quality::full);
  EXPECT_EQ(session_->rgba(), red);
  expect_ok(R"({"command":"set","key":"surface.color","value":"bfactor"})");
  expect_ok(R"({"command":"set","key":"surface.map","value":"magma"})");
  EXPECT_EQ(state()["values"]["surface.color"], Json::array({"bfactor"}));
  EXPECT_EQ(state()["values"]["surface.map"], "magma");
}

TEST_P(PreviewSessionTest, TheLookIsForPicturesAtRest) {
  session_->render(Quality::draft);
  const auto draft = session_->rgba();
  session_->render(Quality::full);
  const auto full = session_->rgba();
  expect_ok(R"({"command":"set","key":"look.ambient_occlusion","value":0.9})");
  expect_ok(R"({"command":"set","key":"look.silhouettes","value":2})");
  EXPECT_EQ(state()["values"]["look.ambient_occlusion"], 0.9);
  EXPECT_EQ(state()["values"]["look.silhouettes"], 2.0);
  session_->render(Quality::draft);
  EXPECT_EQ(session_->rgba(), draft);
  session_->render(Quality::full);
  EXPECT_NE(session_->rgba(), full);
  expect_ok(R"({"command":"set","key":"look.light","value":"1,0,0.5"})");
  session_->render(Quality::draft);
  EXPECT_NE(session_->rgba(), draft);
}

TEST_P(PreviewSessionTest, ACameraComesBackAsItWas) {
  expect_ok(R"({"command":"orbit","dx":0.123,"dy":0.0456})");
  const Json camera = state()["camera"];
  expect_ok(R"({"command":"reset_view"})");
  EXPECT_NE(state()["camera"], camera);
  session_->apply({{"command", "camera"}, {"camera", camera}});
  EXPECT_EQ(state()["camera"], camera);
}

TEST_P(PreviewSessionTest, ExportsAreWholeAndReplaceNothing) {
  const std::string png = R"({"command":"export","format":"png","path":"view.png","width":50,"height":40)";
  expect_ok(png + "}");
  EXPECT_EQ(apply(png + "}")["ok"], false);
  expect_ok(png + R"(,"force":true})");
  expect_ok(R"({"command":"export","format":"camera","path":"view.json"})");
  expect_ok(R"({"command":"export","format":"blender","path":"view.mns"})");
  const Json povray = apply(R"({"command":"export","format":"povray","path":"scene"})");
  ASSERT_TRUE(povray["ok"]) << povray;
  EXPECT_NE(povray["render_with"].get<std::string>().find("povray"), std::string::npos);
  EXPECT_EQ(folder_.entries(), (std::vector<std::string>{"scene", "two.pdb", "view.json", "view.mns", "view.png"}));
  EXPECT_EQ(Json::parse(read_bytes(folder_.path() / "view.json")), state()["camera"]);
}

TEST_P(PreviewSessionTest, PlaysOnlyWhatHasFrames) {
  EXPECT_EQ(apply(R"({"command":"play","fps":25})")["playing"], true);
  EXPECT_TRUE(session_->state().playing);
  EXPECT_EQ(session_->state().frames_per_second, 25.0);
  expect_ok(R"({"command":"pause"})");
  EXPECT_FALSE(session_->state().playing);
  expect_ok(R"({"command":"pause","fps":7})");
  EXPECT_EQ(session_->state().frames_per_second, 7.0) << "a pace may be chosen before";
  EXPECT_FALSE(session_->wants_to_quit());
  expect_ok(R"({"command":"quit"})");
  EXPECT_TRUE(session_->wants_to_quit());
}

INSTANTIATE_TEST_SUITE_P(On, PreviewSessionTest, ::testing::Values("cpu", "gl"),
                         [](const auto& device) { return std::string(device.param); });

}  // namespace
}  // namespace meniscus::test
