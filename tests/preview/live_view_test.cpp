// SPDX-License-Identifier: BSD-3-Clause
// The schedule of drafts and full pictures: which picture stops for which change, and how films are drawn.
#include "app/preview/session.h"

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/structure/formats/read_structure.h"
#include "tests/preview/two_models.h"
#include "tests/support/run_program.h"

namespace meniscus::test {
namespace {

// A surface has stages, and none begins for a client that no longer wants the surface.
TEST(LivePictures, SurfacesCanBeGivenUpBetweenStages) {
  const std::unique_ptr<PreviewRenderer> renderer = make_cpu_preview_renderer();
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
  // Another view of the same surface computes no surface.
  camera.position = {0, 0, 30};
  ASSERT_TRUE(renderer->draw(2.0, camera, settings));
  EXPECT_LT(renderer->times().size(), stages);
}

// The first surface of many atoms takes long; balls are shown at once, and never again.
TEST(LivePictures, ManyAtomsAreBallsUntilTheirSurfaceIsThere) {
  const TemporaryFolder folder;
  const auto begin = [&](int side) {
    Structure structure;
    for (int n = 0; n < side * side * side; ++n) {
      Atom& atom = structure.atoms.emplace_back();
      atom.position = 6.0 * glm::dvec3(n % side, n / side % side, n / side / side);
      atom.radius = 1.5;
      atom.element = 8;
      atom.model = 1;
    }
    PreviewState view;
    view.size = {160, 120};
    return std::make_unique<PreviewSession>(make_cpu_preview_renderer(), structure, view, std::nullopt, folder.path());
  };
  const auto nothing_waits = [] { return Change::none; };
  const std::unique_ptr<PreviewSession> few = begin(3), many = begin(28);
  EXPECT_EQ(LiveView(*few).at_once(), Quality::draft);
  LiveView live(*many);
  EXPECT_EQ(live.at_once(), Quality::balls);
  ASSERT_TRUE(live.draw(Quality::balls, nothing_waits));
  const std::vector<std::uint8_t> balls = many->rgba();
  ASSERT_EQ(many->picture_size(), glm::ivec2(160, 120));
  ASSERT_EQ(balls.size(), 4u * 160 * 120);
  EXPECT_EQ(live.at_once(), Quality::draft);
  ASSERT_TRUE(live.draw(Quality::plain, nothing_waits));
  // The balls are where the surface of these atoms is.
  const std::vector<std::uint8_t> surface = many->rgba();
  ASSERT_EQ(surface.size(), balls.size());
  std::size_t shown = 0, differ = 0;
  for (std::size_t p = 0; p < balls.size(); p += 4) {
    const bool ball = balls[p + 2] < 255, point = surface[p + 2] < 255;
    shown += point;
    differ += ball != point;
  }
  EXPECT_GT(shown, 5000u);
  EXPECT_LT(differ, shown / 20);
  ASSERT_TRUE(live.apply({{"command", "orbit"}, {"dx", 0.1}, {"dy", 0.0}})["ok"]);
  EXPECT_EQ(live.at_once(), Quality::draft);
}

// The figure of a page needs the complete surface, which stays while atoms and probe stay.
TEST(LiveFigures, TheirSurfaceIsComputedOnceAndCanBeGivenUp) {
  const TemporaryFolder folder;
  ReadOptions reading;
  reading.model.all = true;
  PreviewSession session(make_cpu_preview_renderer(), read_structure(folder.file("two.pdb", kTwoModels), reading), {},
                         std::nullopt, folder.path());
  int stages = 0;
  const auto stages_after = [&](const char* command) {
    EXPECT_TRUE(session.apply(nlohmann::json::parse(command))["ok"]) << command;
    stages = 0;
    EXPECT_TRUE(session.figure([&] { return ++stages == 0; })) << command;
    return stages - 1;  // the last call is at the end
  };
  const std::uint64_t first = session.figure_revision();
  EXPECT_GT(stages_after(R"({"command":"orbit","dx":0.1,"dy":0})"), 3);
  EXPECT_EQ(session.figure_revision(), first);
  EXPECT_EQ(stages_after(R"({"command":"set","key":"surface.color","value":"chain"})"), 0);
  EXPECT_GT(session.figure_revision(), first);
  for (const char* same :
       {R"({"command":"set","key":"look.ambient","value":0.2})",
        R"({"command":"set","key":"surface.show","value":"name N CA"})",
        R"({"command":"resize","width":90,"height":80})", R"({"command":"set","key":"surface.color","value":"kind"})"})
    EXPECT_EQ(stages_after(same), 0) << same;
  for (const char* other :
       {R"({"command":"set","key":"surface.probe","value":1.5})",
        R"({"command":"set","key":"surface.kind","value":"sas"})",
        R"({"command":"set","key":"surface.kind","value":"vdw"})", R"({"command":"frame","index":1})"})
    EXPECT_GT(stages_after(other), 3) << other;
  ASSERT_TRUE(session.apply({{"command", "set"}, {"key", "surface.kind"}, {"value", "ses"}})["ok"]);
  EXPECT_FALSE(session.figure([] { return true; }));
  EXPECT_TRUE(session.figure());
  // The computation for another surface is given up late, like a draft, so this one is complete by then.
  ASSERT_TRUE(session.apply({{"command", "frame"}, {"index", 0}})["ok"]);
  EXPECT_TRUE(LiveView(session).figure([] { return Change::surface; }));
}

TEST(LivePictures, FramesPlayInFullSizeWhenThereIsTime) {
  const TemporaryFolder folder;
  PreviewState view;
  view.size = {80, 60};
  ReadOptions reading;
  reading.model.all = true;
  PreviewSession session(make_cpu_preview_renderer(), read_structure(folder.file("two.pdb", kTwoModels), reading), view,
                         std::nullopt, folder.path());
  LiveView live(session);
  const auto nothing_waits = [] { return Change::none; };
  ASSERT_TRUE(live.draw(Quality::draft, nothing_waits));
  ASSERT_TRUE(live.apply({{"command", "orbit"}, {"dx", 0.1}, {"dy", 0.0}})["ok"]);
  EXPECT_EQ(live.at_once(), Quality::draft);
  ASSERT_TRUE(live.apply({{"command", "play"}, {"fps", 0.1}})["ok"]);
  EXPECT_EQ(live.at_once(), Quality::draft);  // it is not known yet how long one takes
  ASSERT_TRUE(live.apply({{"command", "next_frame"}})["ok"]);
  ASSERT_TRUE(live.draw(live.at_once(), nothing_waits));
  EXPECT_EQ(live.at_once(), Quality::plain);
  EXPECT_EQ(live.due(LiveView::Clock::now()), Quality::plain);
  // At 240 frames per second, these pictures take as long as those of a slow machine.
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

// Motion never stops a draft; a change that makes it worthless does, if the draft takes long.
TEST(LivePictures, DraftsAreGivenUpForOtherSurfacesOnly) {
  const TemporaryFolder folder;
  PreviewState view;
  view.size = {80, 60};
  PreviewSession session(make_cpu_preview_renderer(), read_structure(folder.file("one.pdb", kTwoModels)), view,
                         std::nullopt, folder.path());
  LiveView live(session);
  EXPECT_FALSE(live.draw(Quality::plain, [] { return Change::view; }));
  EXPECT_TRUE(live.fault().empty());
  ASSERT_TRUE(live.draw(Quality::draft, [] { return Change::view; }));
  ASSERT_TRUE(live.apply({{"command", "set"}, {"key", "surface.probe"}, {"value", 2.0}})["ok"]);
  ASSERT_TRUE(live.draw(Quality::draft, [] { return Change::surface; }));  // at once, so it is shown
  EXPECT_EQ(change_of({{"command", "set"}, {"key", "surface.probe"}, {"value", 2.0}}), Change::surface);
  EXPECT_EQ(change_of({{"command", "orbit"}}), Change::view);
  EXPECT_EQ(change_of({{"command", "export"}}), Change::none);
  EXPECT_EQ(change_of({{"command", "state"}}), Change::none);
}

}  // namespace
}  // namespace meniscus::test
