// SPDX-License-Identifier: BSD-3-Clause
// Copies of one surface in a session are drawn, picked, kept apart and exported.
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/preview/session.h"
#include "core/base/error.h"
#include "core/structure/formats/read_structure.h"
#include "tests/preview/two_models.h"
#include "tests/support/run_program.h"

namespace meniscus::test {
namespace {

using Json = nlohmann::json;

/// Two peptides, one of which is at three places and the other at two.
Structure peptides() {
  const TemporaryFolder folder;
  Structure structure = read_structure(folder.file("two.pdb", kTwoModels), {});
  const auto at = [](double x, double y) { return RigidMotion{glm::dmat3(1.0), {x, y, 0.0}}; };
  structure.instances = {{{0, 1, 2}, {at(0, 0), at(14, 0), at(28, 0)}}, {{3}, {at(0, 20), at(14, 20)}}};
  return structure;
}

PreviewState view_of_copies() {
  PreviewState view;
  view.size = {160, 120};
  view.image.samples = 1;
  view.copies_apart = true;
  return view;
}

// The test runs on the CPU, and with a renderer that draws atoms.
TEST(PreviewCopies, AreDrawnPickedAndKeptApart) {
  const TemporaryFolder folder;
  for (const bool placed : {false, true}) {
    SCOPED_TRACE(placed);
    const Structure structure = peptides();
    PreviewSession session(placed ? make_placed_atoms_renderer(structure.instances, make_cpu_preview_renderer())
                                  : make_cpu_copies_renderer(structure.instances),
                           structure, view_of_copies(), std::nullopt, folder.path());
    const auto apply = [&](const std::string& command) { return session.apply(Json::parse(command)); };
    const Json state = apply(R"({"command":"state"})");
    EXPECT_EQ(state["atoms"], 4);
    EXPECT_EQ(state["copies"], 3);
    ASSERT_TRUE(session.render(Quality::full));
    // A pick where the camera sees an atom of a copy finds this atom.
    const Camera camera = session.state().camera;
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
    const Json close = apply(R"({"command":"set","key":"surface.probe","value":6})");
    EXPECT_FALSE(close["ok"]);
    EXPECT_NE(std::string(close["error"]).find("so near that a probe can touch both copies"), std::string::npos)
        << close;
    EXPECT_FALSE(apply(R"({"command":"set","key":"surface.color","value":"copy"})")["ok"]);
    EXPECT_EQ(apply(R"({"command":"state"})"), before);
    EXPECT_TRUE(apply(R"({"command":"set","key":"surface.probe","value":2})")["ok"]);
    EXPECT_TRUE(session.render(Quality::draft));
  }
  const Structure structure = peptides();
  PreviewState near = view_of_copies();
  near.molecule.surface.probe_radius = 6.0;
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

}  // namespace
}  // namespace meniscus::test
