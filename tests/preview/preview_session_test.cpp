// SPDX-License-Identifier: BSD-3-Clause
// Commands of a preview session: what they answer, what they change, and that a bad one changes nothing.
#include "app/preview/session.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <thread>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/preview/live_view.h"
#include "core/base/error.h"
#include "core/gpu/egl_context.h"
#include "core/structure/formats/read_structure.h"
#include "core/reduced_surface/cpu/exhaustive.h"
#include "core/surface/atom_areas.h"
#include "core/surface/surface.h"
#include "tests/support/run_program.h"

namespace meniscus::test {
namespace {

using Json = nlohmann::json;

// Two models; the oxygen moves. Columns of PDB.
constexpr std::string_view kTwoModels = R"(MODEL        1
ATOM      1  N   ALA A   1       0.000   0.000   0.000  1.00 10.00           N
ATOM      2  CA  ALA A   1       1.458   0.000   0.000  1.00 20.00           C
ATOM      3  C   ALA A   1       2.009   1.420   0.000  1.00 30.00           C
ATOM      4  O   ALA B   2       1.251   2.390   0.000  1.00 40.00           O
ENDMDL
MODEL        2
ATOM      1  N   ALA A   1       0.000   0.000   0.000  1.00 10.00           N
ATOM      2  CA  ALA A   1       1.458   0.000   0.000  1.00 20.00           C
ATOM      3  C   ALA A   1       2.009   1.420   0.000  1.00 30.00           C
ATOM      4  O   ALA B   2       5.251   5.390   0.000  1.00 40.00           O
ENDMDL
END
)";

/// On the CPU and on GL.
class PreviewSessionTest : public ::testing::TestWithParam<const char*> {
 protected:
  PreviewSessionTest() {
    ReadOptions reading;
    reading.model.all = true;
    PreviewView view;
    view.size = {80, 60};
    if (std::string(GetParam()) == "gl") context_.emplace();
    session_ = std::make_unique<PreviewSession>(
        renderer(), read_structure(folder_.file("two.pdb", kTwoModels), reading), view, std::nullopt, folder_.path());
  }

  std::unique_ptr<ViewRenderer> renderer() { return context_ ? make_gl_view_renderer() : make_cpu_view_renderer(); }
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
           R"({"command":"zoom","factor":0})",
           R"({"command":"zoom_to","selection":"chain Z"})",
           R"({"command":"zoom_to","selection":"chain ("})",
           R"({"command":"camera","camera":{"position":[0,0,0]}})",
           R"({"command":"projection","projection":"fish"})",
           R"({"command":"probe","radius":-1})",
           R"({"command":"probe","radius":101})",
           R"({"command":"probe","radius":1e-9})",
           R"({"command":"probe","radius":null})",
           R"({"command":"color","scheme":"rainbow"})",
           R"({"command":"color","scheme":"component"})",
           R"({"command":"color","scheme":"file"})",
           R"({"command":"color","scheme":"charge"})",
           R"({"command":"color","scheme":"chain","map":"viridis"})",
           R"({"command":"color","scheme":"bfactor","map":"jet"})",
           R"({"command":"look","background":"#12"})",
           R"({"command":"look","glow":1})",
           R"({"command":"look","ambient_occlusion":1.5})",
           R"({"command":"look","silhouettes":-1})",
           R"({"command":"look","light_direction":[0,0,0]})",
           R"({"command":"look","light_direction":[1,2]})",
           R"({"command":"look","light_direction":[1,2,"3"]})",
           R"({"command":"look","silhouettes":17})",
           R"({"command":"look","light_direction":[0,0,0]})",
           R"({"command":"look","light_direction":[0,1]})",
           R"({"command":"look","ambient_occlusion":0.5,"depth_cue":2})",
           R"({"command":"frame","index":2})",
           R"({"command":"frame","index":0.5})",
           R"({"command":"resize","width":80,"height":100000})",
           R"({"command":"pick","x":80,"y":0})",
           R"({"command":"export","format":"png","path":"../x.png"})",
           R"({"command":"export","format":"png","path":".x.png"})",
           R"({"command":"export","format":"stl","path":"x.stl"})",
           R"({"command":"export","format":"png","path":"x.gif"})",
           R"({"command":"play","fps":0})",
       }) {
    const Json reply = apply(command);
    EXPECT_FALSE(reply["ok"]) << command;
    const std::string error = reply.value("error", "");
    EXPECT_GT(error.size(), 10u) << command;
    EXPECT_EQ(error.find('\n'), std::string::npos) << command;
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
  expect_ok(R"({"command":"samples","count":4})");
  int asked = 0;
  EXPECT_FALSE(session_->render(Quality::full, [&] { return ++asked == 2; }));
  EXPECT_EQ(asked, 2);
  EXPECT_FALSE(session_->is_drawn(Quality::full));
  EXPECT_EQ(session_->rgba(), draft);
  ASSERT_TRUE(session_->render(Quality::full, [] { return false; }));
  const auto full = session_->rgba();
  expect_ok(R"({"command":"samples","count":4})");
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
  expect_ok(R"({"command":"zoom","factor":1.1})");
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

TEST_P(PreviewSessionTest, PatchKindsColourWhateverTheSchemeIs) {
  expect_ok(R"({"command":"color","scheme":"#ff0000"})");
  expect_ok(R"({"command":"patch_kinds","on":true})");
  session_->render(Quality::full);
  const auto kinds = session_->rgba();
  expect_ok(R"({"command":"patch_kinds","on":false})");
  expect_ok(R"({"command":"color","scheme":"kind"})");
  session_->render(Quality::full);
  EXPECT_EQ(session_->rgba(), kinds);
  expect_ok(R"({"command":"color","scheme":"bfactor","map":"magma"})");
  EXPECT_EQ(state()["color"], Json::parse(R"({"scheme":"bfactor","map":"magma"})"));
}

TEST_P(PreviewSessionTest, TheLookIsForPicturesAtRest) {
  session_->render(Quality::draft);
  const auto draft = session_->rgba();
  session_->render(Quality::full);
  const auto full = session_->rgba();
  const Json look = Json::parse(R"({"ambient_occlusion":0.9,"silhouettes":2.0})");
  expect_ok(R"({"command":"look","ambient_occlusion":0.9,"silhouettes":2})");
  for (const auto& [key, value] : look.items()) EXPECT_EQ(state()["look"][key], value) << key;
  session_->render(Quality::draft);
  EXPECT_EQ(session_->rgba(), draft);
  session_->render(Quality::full);
  EXPECT_NE(session_->rgba(), full);
  expect_ok(R"({"command":"look","light_direction":[1,0,0.5]})");
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
  EXPECT_TRUE(session_->playing());
  EXPECT_EQ(session_->frames_per_second(), 25.0);
  expect_ok(R"({"command":"pause"})");
  EXPECT_FALSE(session_->playing());
  EXPECT_FALSE(session_->wants_to_quit());
  expect_ok(R"({"command":"quit"})");
  EXPECT_TRUE(session_->wants_to_quit());
}

INSTANTIATE_TEST_SUITE_P(On, PreviewSessionTest, ::testing::Values("cpu", "gl"),
                         [](const auto& device) { return std::string(device.param); });

// A surface takes stages, and none is begun for somebody who does not want it any more.
TEST(PreviewView, SurfacesCanBeGivenUpBetweenStages) {
  const std::unique_ptr<ViewRenderer> renderer = make_cpu_view_renderer();
  renderer->set_atoms({{{0, 0, 0}, 1.7}, {{3, 0, 0}, 1.5}});
  Coloring coloring;
  coloring.atom.assign(2, glm::vec3(0.5f));
  renderer->set_coloring(coloring);
  Camera camera;
  camera.position = {0, 0, 20};
  RenderSettings settings;
  settings.size = {40, 30};
  ASSERT_TRUE(renderer->draw(1.4, camera, settings));
  ASSERT_TRUE(renderer->surface());
  const std::vector<std::uint8_t> before = renderer->rgba();
  const std::size_t stages = renderer->times().size();
  int asked = 0;
  EXPECT_FALSE(renderer->draw(2.0, camera, settings, [&] { return ++asked == 3; }));
  EXPECT_EQ(asked, 3);
  EXPECT_FALSE(renderer->surface());
  EXPECT_EQ(renderer->rgba(), before);
  ASSERT_TRUE(renderer->draw(2.0, camera, settings, [] { return false; }));
  EXPECT_EQ(renderer->surface()->probe_radius, 2.0);
  EXPECT_NE(renderer->rgba(), before);
  // Another view of the same surface computes none.
  camera.position = {0, 0, 30};
  ASSERT_TRUE(renderer->draw(2.0, camera, settings));
  EXPECT_LT(renderer->times().size(), stages);
}

TEST(PreviewView, FramesPlayInFullSizeWhenThereIsTime) {
  const TemporaryFolder folder;
  PreviewView view;
  view.size = {80, 60};
  ReadOptions reading;
  reading.model.all = true;
  PreviewSession session(make_cpu_view_renderer(), read_structure(folder.file("two.pdb", kTwoModels), reading), view,
                         std::nullopt, folder.path());
  LiveView live(session);
  const auto nothing_waits = [] { return Change::none; };
  ASSERT_TRUE(live.draw(Quality::draft, nothing_waits));
  ASSERT_TRUE(live.apply({{"command", "orbit"}, {"dx", 0.1}, {"dy", 0.0}})["ok"]);
  EXPECT_EQ(live.at_once(), Quality::draft);
  ASSERT_TRUE(live.apply({{"command", "play"}, {"fps", 0.1}})["ok"]);
  EXPECT_EQ(live.at_once(), Quality::draft);  // nobody knows yet how long one takes
  ASSERT_TRUE(live.apply({{"command", "next_frame"}})["ok"]);
  ASSERT_TRUE(live.draw(live.at_once(), nothing_waits));
  EXPECT_EQ(live.at_once(), Quality::plain);
  EXPECT_EQ(live.due(LiveView::Clock::now()), Quality::plain);
  // 240 frames a second of pictures that take as long as a slow machine's.
  ASSERT_TRUE(live.apply({{"command", "play"}, {"fps", 240.0}})["ok"]);
  ASSERT_TRUE(live.apply({{"command", "next_frame"}})["ok"]);
  ASSERT_TRUE(live.draw(Quality::plain, [] {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return Change::none;
  }));
  EXPECT_EQ(live.at_once(), Quality::draft);
  ASSERT_TRUE(live.apply({{"command", "pause"}})["ok"]);
  EXPECT_EQ(live.at_once(), Quality::draft);
}

// What moves never costs a draft; what makes it worthless does, when it takes long.
TEST(PreviewView, DraftsAreGivenUpForOtherSurfacesOnly) {
  const TemporaryFolder folder;
  PreviewView view;
  view.size = {80, 60};
  PreviewSession session(make_cpu_view_renderer(), read_structure(folder.file("one.pdb", kTwoModels)), view,
                         std::nullopt, folder.path());
  LiveView live(session);
  EXPECT_FALSE(live.draw(Quality::plain, [] { return Change::view; }));
  EXPECT_TRUE(live.fault().empty());
  ASSERT_TRUE(live.draw(Quality::draft, [] { return Change::view; }));
  ASSERT_TRUE(live.apply({{"command", "probe"}, {"radius", 2.0}})["ok"]);
  ASSERT_TRUE(live.draw(Quality::draft, [] { return Change::surface; }));  // at once, so it is shown
  EXPECT_EQ(change_of({{"command", "probe"}, {"radius", 2.0}}), Change::surface);
  EXPECT_EQ(change_of({{"command", "orbit"}}), Change::view);
  EXPECT_EQ(change_of({{"command", "export"}}), Change::none);
  EXPECT_EQ(change_of({{"command", "state"}}), Change::none);
}

// One atom walks along x; its third step cannot be read.
/// Two peptides, one of which stands at three places and the other at two.
Structure peptides() {
  const TemporaryFolder folder;
  Structure structure = read_structure(folder.file("two.pdb", kTwoModels), {});
  const auto at = [](double x, double y) { return RigidMotion{glm::dmat3(1.0), {x, y, 0.0}}; };
  structure.instances = {{{0, 1, 2}, {at(0, 0), at(14, 0), at(28, 0)}}, {{3}, {at(0, 20), at(14, 20)}}};
  return structure;
}

PreviewView view_of_copies() {
  PreviewView view;
  view.size = {160, 120};
  view.samples = 1;
  view.copies_apart = true;
  return view;
}

// On the CPU, and by what draws atoms.
TEST(PreviewCopies, AreDrawnPickedAndKeptApart) {
  const TemporaryFolder folder;
  for (const bool placed : {false, true}) {
    SCOPED_TRACE(placed);
    const Structure structure = peptides();
    PreviewSession session(placed ? make_placed_atoms_renderer(structure.instances, make_cpu_view_renderer())
                                  : make_cpu_copies_renderer(structure.instances),
                           structure, view_of_copies(), std::nullopt, folder.path());
    const auto apply = [&](const std::string& command) { return session.apply(Json::parse(command)); };
    const Json state = apply(R"({"command":"state"})");
    EXPECT_EQ(state["atoms"], 4);
    EXPECT_EQ(state["copies"], 3);
    EXPECT_EQ(state["placed_atoms"], 11);
    ASSERT_TRUE(session.render(Quality::full));
    // Where the camera sees an atom of a copy that is what a pick finds.
    const Camera camera = session.view().camera;
    const auto pick_at = [&](const glm::dvec3& point) {
      const ViewBasis basis = view_basis(camera);
      const glm::dvec3 v = point - camera.position;
      const glm::dvec2 half = half_extent(camera, 160.0 / 120.0) * glm::dot(v, basis.forward);
      return apply(fmt::format(R"({{"command":"pick","x":{},"y":{}}})",
                               static_cast<int>(80.0 * (1.0 + glm::dot(v, basis.right) / half.x)),
                               static_cast<int>(60.0 * (1.0 - glm::dot(v, basis.up) / half.y))));
    };
    const Json third = pick_at(structure.atoms[0].position + glm::dvec3(28, 0, 0));
    EXPECT_EQ(third["name"], "N");
    EXPECT_EQ(third["copy"], 3);
    const Json oxygen = pick_at(structure.atoms[3].position + glm::dvec3(14, 20, 0));
    EXPECT_EQ(oxygen["name"], "O");
    EXPECT_EQ(oxygen["copy"], 2);
    const double radius = structure.atoms[3].radius;
    EXPECT_NEAR(oxygen["exposed_area"], 4.0 * std::numbers::pi * radius * radius, 1e-6) << "as if it were alone";
    EXPECT_EQ(apply(R"({"command":"zoom_to","selection":"name O"})")["atoms"], 1);

    const Json before = apply(R"({"command":"state"})");
    const Json close = apply(R"({"command":"probe","radius":6})");
    EXPECT_FALSE(close["ok"]);
    EXPECT_NE(std::string(close["error"]).find("so near that copies of one surface"), std::string::npos) << close;
    EXPECT_FALSE(apply(R"({"command":"color","scheme":"copy"})")["ok"]);
    EXPECT_EQ(apply(R"({"command":"state"})"), before);
    EXPECT_TRUE(apply(R"({"command":"probe","radius":2})")["ok"]);
    EXPECT_TRUE(session.render(Quality::draft));
  }
  const Structure structure = peptides();
  PreviewView near = view_of_copies();
  near.probe_radius = 6.0;
  EXPECT_THROW(
      PreviewSession(make_cpu_copies_renderer(structure.instances), structure, near, std::nullopt, folder.path()),
      InputError);
}

TEST(PreviewCopies, AreExported) {
  const TemporaryFolder folder;
  const Structure structure = peptides();
  PreviewSession session(make_cpu_copies_renderer(structure.instances), structure, view_of_copies(), std::nullopt,
                         folder.path());
  for (const char* command :
       {R"({"command":"export","format":"png","path":"a.png"})", R"({"command":"export","format":"povray","path":"a"})",
        R"({"command":"export","format":"blender","path":"a.mns"})"}) {
    const Json reply = session.apply(Json::parse(command));
    EXPECT_TRUE(reply["ok"]) << reply;
  }
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"a", "a.mns", "a.png"}));
}

TEST(PreviewMoments, FramesOfATrajectory) {
  const TemporaryFolder folder;
  const Structure structure = read_structure(folder.file("one.pdb", kTwoModels));
  std::vector<glm::dvec3> start;
  for (const Atom& atom : structure.atoms) start.push_back(atom.position);
  TrajectoryPositions moments{{10, 20, 30, 40}, [start](std::size_t frame) {
                                if (frame == 2) throw InputError("walk.dcd", 0, "frame 2 is damaged");
                                std::vector<glm::dvec3> positions = start;
                                positions.back().x += 30.0 * static_cast<double>(frame);
                                return positions;
                              }};
  PreviewView view;
  view.size = {80, 60};
  PreviewSession session(make_cpu_view_renderer(), structure, view, std::nullopt, folder.path(), moments);
  const auto apply = [&](const char* command) { return session.apply(Json::parse(command)); };
  EXPECT_EQ(apply(R"({"command":"state"})")["frames"], 4);
  // The first view holds all of the walk: the last place of the atom is in the picture.
  ASSERT_TRUE(apply(R"({"command":"frame","index":3})")["ok"]);
  ASSERT_TRUE(session.render(Quality::plain));
  const std::vector<std::uint8_t> with = session.rgba();
  EXPECT_EQ(session.structure().atoms.back().position.x, start.back().x + 90.0);
  ASSERT_TRUE(apply(R"({"command":"frame","index":0})")["ok"]);
  ASSERT_TRUE(session.render(Quality::plain));
  EXPECT_NE(session.rgba(), with);
  // A bad frame is an error that changes nothing; playing passes over it.
  const Json bad = apply(R"({"command":"frame","index":2})");
  EXPECT_FALSE(bad["ok"]);
  EXPECT_NE(bad["error"].get<std::string>().find("frame 2 is damaged"), std::string::npos);
  EXPECT_EQ(apply(R"({"command":"state"})")["frame"], 0);
  EXPECT_EQ(apply(R"({"command":"next_frame"})")["frame"], 1);
  EXPECT_EQ(apply(R"({"command":"next_frame"})")["frame"], 3);
  EXPECT_EQ(apply(R"({"command":"next_frame"})")["frame"], 0);
}

TEST(PreviewMoments, KeysOfTheCamera) {
  const TemporaryFolder folder;
  const Structure structure = read_structure(folder.file("one.pdb", kTwoModels));
  std::vector<glm::dvec3> positions;
  for (const Atom& atom : structure.atoms) positions.push_back(atom.position);
  PreviewView view;
  view.size = {80, 60};
  PreviewSession session(make_cpu_view_renderer(), structure, view, std::nullopt, folder.path(),
                         TrajectoryPositions{{10, 20, 30, 40}, [positions](std::size_t) { return positions; }});
  const auto apply = [&](const char* command) { return session.apply(Json::parse(command)); };
  const char* kExport = R"({"command":"export","format":"camera_path","path":"path.json","force":true})";
  EXPECT_FALSE(apply(kExport)["ok"]);  // none yet
  EXPECT_EQ(apply(R"({"command":"key"})")["keys"], 1);
  const Camera first = session.view().camera;
  apply(R"({"command":"frame","index":3})");
  apply(R"({"command":"orbit","dx":0.5,"dy":0.1})");
  EXPECT_EQ(apply(R"({"command":"key"})")["keys"], 2);
  const Camera last = session.view().camera;
  // The file has the numbers of the trajectory, and moves the camera as the preview does.
  ASSERT_TRUE(apply(kExport)["ok"]);
  const CameraPath path = read_camera_path((folder.path() / "path.json").string());
  EXPECT_EQ(path.at(10).position, first.position);
  EXPECT_EQ(path.at(40).position, last.position);
  ASSERT_TRUE(apply(R"({"command":"follow_keys","on":true})")["ok"]);
  apply(R"({"command":"frame","index":1})");
  EXPECT_EQ(session.view().camera.position, path.at(20).position);
  EXPECT_GT(glm::distance(session.view().camera.position, first.position), 0.1);
  // Keys of two projections make no path.
  apply(R"({"command":"projection","projection":"orthographic"})");
  EXPECT_FALSE(apply(R"({"command":"key"})")["ok"]);
  apply(R"({"command":"frame","index":3})");
  EXPECT_EQ(apply(R"({"command":"key","on":false})")["keys"], 1);
}

}  // namespace
}  // namespace meniscus::test
