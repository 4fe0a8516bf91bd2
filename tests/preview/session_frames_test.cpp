// SPDX-License-Identifier: BSD-3-Clause
// Frames of a trajectory in a session, and keys of the camera at them.
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/preview/session.h"
#include "core/base/error.h"
#include "core/camera/camera.h"
#include "core/camera/camera_json.h"
#include "core/structure/formats/read_structure.h"
#include "tests/preview/two_models.h"
#include "tests/support/run_program.h"

namespace meniscus::test {
namespace {

using Json = nlohmann::json;

// One atom walks along x; its third step cannot be read.
TEST(PreviewFrames, FramesOfATrajectory) {
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
  PreviewState view;
  view.size = {80, 60};
  PreviewSession session(make_cpu_preview_renderer(), structure, view, std::nullopt, folder.path(), moments);
  const auto apply = [&](const char* command) { return session.apply(Json::parse(command)); };
  EXPECT_EQ(apply(R"({"command":"state"})")["frames"], 4);
  // The first view shows the whole walk: the last place of the atom is in the picture.
  ASSERT_TRUE(apply(R"({"command":"frame","index":3})")["ok"]);
  ASSERT_TRUE(session.render(Quality::plain));
  const std::vector<std::uint8_t> with = session.rgba();
  EXPECT_EQ(session.structure().atoms.back().position.x, start.back().x + 90.0);
  ASSERT_TRUE(apply(R"({"command":"frame","index":0})")["ok"]);
  ASSERT_TRUE(session.render(Quality::plain));
  EXPECT_NE(session.rgba(), with);
  // A bad frame is an error that changes nothing; playing skips it.
  const Json bad = apply(R"({"command":"frame","index":2})");
  EXPECT_FALSE(bad["ok"]);
  EXPECT_NE(bad["error"].get<std::string>().find("frame 2 is damaged"), std::string::npos);
  EXPECT_EQ(apply(R"({"command":"state"})")["frame"], 0);
  EXPECT_EQ(apply(R"({"command":"next_frame"})")["frame"], 1);
  EXPECT_EQ(apply(R"({"command":"next_frame"})")["frame"], 3);
  EXPECT_EQ(apply(R"({"command":"next_frame"})")["frame"], 0);
}

// If each frame has other atoms, pictures, colours and counts are those of the frame.
TEST(PreviewFrames, AtomsThatComeAndGo) {
  const TemporaryFolder folder;
  const Structure all = read_structure(folder.file("one.pdb", kTwoModels));
  const auto at = [all](std::size_t frame) {
    if (frame == 2) throw InputError("walk.dcd", 0, "frame 2 is damaged");
    Structure structure = all;
    structure.atoms.resize(all.atoms.size() - frame);
    return structure;
  };
  TrajectoryPositions moments{{0, 1, 2}, {}, at};
  PreviewState view;
  view.size = {80, 60};
  PreviewSession session(make_cpu_preview_renderer(), all, view, std::nullopt, folder.path(), moments);
  const auto apply = [&](const char* command) { return session.apply(Json::parse(command)); };
  ASSERT_TRUE(session.render(Quality::plain));
  const std::vector<std::uint8_t> first = session.rgba();
  ASSERT_TRUE(apply(R"({"command":"frame","index":1})")["ok"]);
  EXPECT_EQ(session.structure().atoms.size(), all.atoms.size() - 1);
  ASSERT_TRUE(session.render(Quality::plain));
  EXPECT_NE(session.rgba(), first);
  EXPECT_FALSE(apply(R"({"command":"frame","index":2})")["ok"]);
  EXPECT_EQ(session.structure().atoms.size(), all.atoms.size() - 1);
  ASSERT_TRUE(apply(R"({"command":"frame","index":0})")["ok"]);
  ASSERT_TRUE(session.render(Quality::plain));
  EXPECT_EQ(session.rgba(), first);
}

TEST(PreviewFrames, KeysOfTheCamera) {
  const TemporaryFolder folder;
  const Structure structure = read_structure(folder.file("one.pdb", kTwoModels));
  std::vector<glm::dvec3> positions;
  for (const Atom& atom : structure.atoms) positions.push_back(atom.position);
  PreviewState view;
  view.size = {80, 60};
  PreviewSession session(make_cpu_preview_renderer(), structure, view, std::nullopt, folder.path(),
                         TrajectoryPositions{{10, 20, 30, 40}, [positions](std::size_t) { return positions; }});
  const auto apply = [&](const char* command) { return session.apply(Json::parse(command)); };
  const char* kExport = R"({"command":"export","format":"camera_path","path":"path.json","force":true})";
  EXPECT_FALSE(apply(kExport)["ok"]);  // there is no key yet
  ASSERT_TRUE(session.render(Quality::full));
  EXPECT_EQ(apply(R"({"command":"key"})")["keys"], 1);
  EXPECT_TRUE(session.is_drawn(Quality::full)) << "the same picture";
  const Camera first = session.state().camera;
  apply(R"({"command":"frame","index":3})");
  apply(R"({"command":"orbit","dx":0.5,"dy":0.1})");
  EXPECT_EQ(apply(R"({"command":"key"})")["keys"], 2);
  const Camera last = session.state().camera;
  // The file has the numbers of the trajectory, and moves the camera as the preview does.
  ASSERT_TRUE(apply(kExport)["ok"]);
  const CameraPath path = read_camera_path((folder.path() / "path.json").string());
  EXPECT_EQ(path.at(10).position, first.position);
  EXPECT_EQ(path.at(40).position, last.position);
  ASSERT_TRUE(apply(R"({"command":"follow_keys","on":true})")["ok"]);
  apply(R"({"command":"frame","index":1})");
  EXPECT_EQ(session.state().camera.position, path.at(20).position);
  EXPECT_GT(glm::distance(session.state().camera.position, first.position), 0.1);
  // Keys of two projections make no path.
  apply(R"({"command":"set","key":"camera.projection","value":"orthographic"})");
  EXPECT_FALSE(apply(R"({"command":"key"})")["ok"]);
  apply(R"({"command":"frame","index":3})");
  EXPECT_EQ(apply(R"({"command":"key","on":false})")["keys"], 1);
}

}  // namespace
}  // namespace meniscus::test
