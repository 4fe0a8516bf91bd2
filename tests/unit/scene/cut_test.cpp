// SPDX-License-Identifier: BSD-3-Clause
// Cuts by atoms: their text, the atoms that they follow, and their places.
#include "core/scene/cut.h"

#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/scene/scene_picture.h"
#include "core/scene/scene_values.h"

namespace meniscus {
namespace {

/// Returns a protein's atoms before and behind a ligand at the origin, seen along -z; the ligand is outside of the
/// surface or part of it.
Structure pocket(bool ligand_beside) {
  Structure structure;
  const auto add = [](std::vector<Atom>& atoms, const char* residue, const glm::dvec3& position) {
    Atom atom;
    atom.name = "C";
    atom.residue_name = residue;
    atom.position = position;
    atom.radius = 1.7;
    atoms.push_back(atom);
  };
  for (const double z : {-10.0, 10.0})
    for (const double x : {-2.0, 0.0, 2.0})
      for (const double y : {-2.0, 0.0, 2.0}) add(structure.atoms, "ALA", {x, y, z});
  std::vector<Atom>& ligand = ligand_beside ? structure.extra_atoms : structure.atoms;
  add(ligand, "LIG", {-0.5, 0.0, -1.0});
  add(ligand, "LIG", {0.5, 0.0, 2.0});
  return structure;
}

Camera camera() {
  Camera camera;
  camera.position = {0.0, 0.0, 60.0};
  camera.projection = Projection::orthographic;
  camera.height = 30.0;
  return camera;
}

ClipPlane plane_of(const char* text, const Structure& structure) {
  const std::vector<Cut> cuts{parse_cut(text)};
  std::vector<Ball> balls;
  for (const Atom& atom : structure.atoms) balls.push_back({atom.position, atom.radius});
  return clip_planes(cuts, cut_atoms(cuts, structure), {camera(), balls, balls}).front();
}

TEST(CutByAtoms, IsWrittenAsItIsRead) {
  for (const char* text : {"through ligand", "before chain A and (resid 7 or bfactor > 50)"})
    EXPECT_EQ(cut_text(parse_cut(text)), text);
  EXPECT_EQ(cut_text(parse_cut("  before (ligand)")), "before (ligand)");
  EXPECT_EQ(cut_text(parse_cut("x < 20")), "x<20");
  EXPECT_THROW(parse_cut("before"), RequestError);
  EXPECT_THROW(parse_cut("through  "), RequestError);
  EXPECT_THROW(parse_cut("behind ligand"), RequestError);
  EXPECT_THROW(parse_cut("before chain ("), SelectionError);
}

TEST(CutByAtoms, FacesTheViewer) {
  for (const bool beside : {false, true}) {
    const Structure structure = pocket(beside);
    const ClipPlane through = plane_of("through resn LIG", structure), before = plane_of("before resn LIG", structure);
    for (const ClipPlane& plane : {through, before}) EXPECT_LT(glm::distance(plane.normal, {0, 0, 1}), 1e-12);
    EXPECT_NEAR(through.offset, 0.5, 1e-12);  // It goes through the middle of the ligand's atoms.
    EXPECT_GT(before.offset, 3.7);            // The plane cuts none of them.
    EXPECT_LT(before.offset, 8.3);            // The wall before them is gone.
  }
}

TEST(CutByAtoms, IsNotAboutWhatIsHidden) {
  const Structure structure = pocket(true);
  const std::vector<Cut> cuts{parse_cut("before resn LIG")};
  std::vector<Ball> balls;
  Coloring coloring;
  for (const Atom& atom : structure.atoms) {
    balls.push_back({atom.position, atom.radius});
    coloring.hidden.push_back(atom.position.z > 0.0);
  }
  const std::vector<Ball> shown = shown_balls(balls, coloring);
  EXPECT_EQ(shown.size(), 9u);
  const ClipPlane plane = clip_planes(cuts, cut_atoms(cuts, structure), {camera(), balls, shown}).front();
  EXPECT_NEAR(plane.offset, -8.3, 1e-12);  // All shown atoms stay.
}

TEST(CutByAtoms, NeedsSome) {
  const Structure structure = pocket(true);
  const std::vector<Cut> cuts{parse_cut("x<3"), parse_cut("before resn XYZ")};
  try {
    cut_atoms(cuts, structure);
    FAIL();
  } catch (const RequestError& error) {
    EXPECT_NE(std::string(error.what()).find("'before resn XYZ': selects none of the 20 atoms"), std::string::npos)
        << error.what();
  }
  EXPECT_TRUE(cut_atoms({cuts.data(), 1}, structure).empty());
}

TEST(CutByAtoms, SaysWhatItLeavesHidden) {
  Structure structure = pocket(false);
  structure.atoms.back().position = {0.5, 0.0, 20.0};  // This atom of the ligand is before the wall.
  const std::vector<Cut> cuts{parse_cut("before resn LIG")};
  std::vector<Ball> balls;
  for (const Atom& atom : structure.atoms) balls.push_back({atom.position, atom.radius});
  const std::vector<std::string> said =
      ineffective_cuts(cuts, cut_atoms(cuts, structure), {camera(), balls, balls}, balls);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_TRUE(said.front().starts_with("before resn LIG leaves them ")) << said.front();
}

// What a surface is cut for lies deep, and shall not fade.
TEST(LookOfAPocket, HasNoDepthCueUnlessItIsAskedFor) {
  const auto depth_cue = [](const char* clip, const LookRequest& request = {}) {
    Scene scene;
    scene.look = request;
    scene.image.background = glm::vec3(1.0f);  // without one, presets have no depth cue
    set_value(scene, property_of("surface.clip"), std::vector<std::string>{clip});
    return render_settings(scene, PictureLayout(scene, {})).look.depth_cue;
  };
  EXPECT_EQ(depth_cue("before ligand"), 0.0f);
  EXPECT_EQ(depth_cue("through ligand"), 0.0f);
  EXPECT_GT(depth_cue("depth>0.5"), 0.0f);
  LookRequest asked;
  asked.depth_cue = 0.2f;
  EXPECT_EQ(depth_cue("before ligand", asked), 0.2f);
}

}  // namespace
}  // namespace meniscus
