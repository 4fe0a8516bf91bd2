// SPDX-License-Identifier: BSD-3-Clause
// Scenes through the C interface: values by their names in the table, JSON both ways, and the program's pictures.
#include <cstring>
#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene_values.h"
#include "tests/c_api/c_objects.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

using namespace test;

/// Two residues of two chains.
constexpr std::string_view kMolecule =
    "ATOM      1  N   ALA A   1       0.000   0.000   0.000  1.00 10.00           N  \n"
    "ATOM      2  CA  ALA A   1       1.458   0.000   0.000  1.00 20.00           C  \n"
    "ATOM      3  C   ALA A   1       2.009   1.420   0.000  1.00 30.00           C  \n"
    "ATOM      4  N   GLY B   2       3.332   1.536   0.000  1.00 15.00           N  \n"
    "ATOM      5  CA  GLY B   2       3.987   2.839   0.000  1.00 25.00           C  \n"
    "ATOM      6  O   GLY B   2       4.900   3.100   1.300  1.00 12.00           O  \n"
    "END\n";

std::string said() { return meniscus_last_error(); }

std::string value_of(const SceneOf& scene, const char* name, std::size_t n = 0) {
  const char* value = nullptr;
  EXPECT_EQ(meniscus_scene_get(scene.get(), name, n, &value), MENISCUS_OK) << said();
  return value ? value : "default";
}

std::string json_of(const SceneOf& scene, const char* folder = nullptr) {
  const char* json = nullptr;
  EXPECT_EQ(meniscus_scene_json(scene.get(), folder, &json), MENISCUS_OK) << said();
  return json ? json : "";
}

meniscus_status parsed(const std::string& json) {
  meniscus_scene* scene = nullptr;
  const meniscus_status status = meniscus_scene_parse(json.c_str(), &scene);
  EXPECT_EQ(scene == nullptr, status != MENISCUS_OK);
  meniscus_scene_release(scene);
  return status;
}

std::vector<std::uint8_t> drawn(const SceneOf& scene) {
  std::int32_t width = 0, height = 0;
  EXPECT_EQ(meniscus_scene_size(scene.get(), &width, &height), MENISCUS_OK) << said();
  std::vector<std::uint8_t> rgba(std::size_t{4} * width * height);
  const Renderer draws = renderer(MENISCUS_CPU);
  EXPECT_EQ(meniscus_render_scene(draws.get(), scene.get(), rgba.data(), rgba.size()), MENISCUS_OK) << said();
  return rgba;
}

TEST(CApiScenes, HaveEveryValueOfTheTableByNameAndByKey) {
  meniscus_array array{};
  ASSERT_EQ(meniscus_scene_properties(&array), MENISCUS_OK);
  ASSERT_EQ(array.stride, sizeof(meniscus_property));
  const auto* const rows = static_cast<const meniscus_property*>(array.data);
  std::size_t held = 0;
  for (const Property* property : properties()) held += is_scene_value(*property);
  EXPECT_EQ(array.count, held);
  std::set<std::string_view> names;
  const SceneOf scene = scene_with({});
  for (std::size_t n = 0; n < array.count; ++n) {
    EXPECT_TRUE(names.insert(rows[n].name).second) << rows[n].name << " is the name of two";
    EXPECT_EQ(value_of(scene, rows[n].name), "default");
    EXPECT_EQ(value_of(scene, rows[n].key), "default");
  }
  EXPECT_TRUE(names.contains("depth_cue") && names.contains("keep_water") && names.contains("file"));
}

TEST(CApiScenes, KeepWhatIsSetInTheUnitsOfTheTable) {
  const SceneOf scene = scene_with({{"silhouettes", "7pt"}, {"look.depth_cue", "0.25"}, {"keep_water", "true"}});
  EXPECT_EQ(value_of(scene, "look.silhouettes"), "7pt");
  EXPECT_EQ(value_of(scene, "depth_cue"), "0.25");
  EXPECT_EQ(value_of(scene, "keep_water"), "true");
  ASSERT_EQ(meniscus_scene_set(scene.get(), "keep_water", "false"), MENISCUS_OK);
  ASSERT_EQ(meniscus_scene_set(scene.get(), "silhouettes", nullptr), MENISCUS_OK);
  EXPECT_EQ(value_of(scene, "keep_water"), "default");
  EXPECT_EQ(value_of(scene, "silhouettes"), "default");
  EXPECT_EQ(value_of(scene, "depth_cue"), "0.25");
  // Repeated values are added; nullptr removes all.
  for (const char* const label : {"resid 1=one", "resid 2=two"})
    ASSERT_EQ(meniscus_scene_set(scene.get(), "label", label), MENISCUS_OK);
  EXPECT_EQ(value_of(scene, "label", 1), "resid 2=two");
  EXPECT_EQ(value_of(scene, "label", 2), "default");
  ASSERT_EQ(meniscus_scene_set(scene.get(), "label", nullptr), MENISCUS_OK);
  EXPECT_EQ(value_of(scene, "label"), "default");
  // The option hide_surface is given where the scene file's key is false.
  ASSERT_EQ(meniscus_scene_set(scene.get(), "surface.shown", "false"), MENISCUS_OK);
  EXPECT_EQ(value_of(scene, "surface.shown"), "false");
  EXPECT_EQ(value_of(scene, "hide_surface"), "true");
  ASSERT_EQ(meniscus_scene_set(scene.get(), "scale_bar", "true"), MENISCUS_OK);
  EXPECT_EQ(value_of(scene, "scale_bar"), "auto");
  std::int32_t width = 0, height = 0;
  ASSERT_EQ(meniscus_scene_set(scene.get(), "width", "1in"), MENISCUS_OK);
  ASSERT_EQ(meniscus_scene_size(scene.get(), &width, &height), MENISCUS_OK);
  EXPECT_EQ(width, 300);
  EXPECT_EQ(height, 225);
}

TEST(CApiScenes, SayWhatTheyCannotTake) {
  const SceneOf scene = scene_with({{"depth_cue", "0.25"}});
  const auto refused = [&](const char* name, const char* value, const char* words) {
    EXPECT_EQ(meniscus_scene_set(scene.get(), name, value), MENISCUS_USAGE) << name;
    EXPECT_NE(said().find(words), std::string::npos) << said();
  };
  refused("silhouetes", "1", "'silhouetes' is not a value of a scene; did you mean silhouettes?");
  refused("stats", "true", "'stats' is not a value of a scene");
  refused("silhouettes", "7pq", "silhouettes: '7pq' is not a length");
  refused("depth_cue", "1.5", "depth_cue: '1.5' is not a number from 0 to 1");
  refused("keep_water", "maybe", "keep_water: 'maybe' is neither true nor false");
  refused("surface", "ess", "surface: 'ess' is not one of");
  refused("select", "chain", "select: ");
  EXPECT_NE(said().find("\n     ^"), std::string::npos) << said();
  EXPECT_EQ(value_of(scene, "depth_cue"), "0.25");

  EXPECT_EQ(parsed("{\n\"meniscus_scene\": 1,"), MENISCUS_INPUT);
  EXPECT_NE(said().find("json:2"), std::string::npos) << said();
  EXPECT_EQ(parsed(R"({"meniscus_scene": 1, "look": {"silhouetes": 1}})"), MENISCUS_INPUT);
  EXPECT_NE(said().find("look.silhouetes"), std::string::npos) << said();
  EXPECT_EQ(parsed(R"({"meniscus_scene": 1, "look": {"depth_cue": 2}})"), MENISCUS_INPUT);
  EXPECT_EQ(said(), "json: look.depth_cue: '2' is not a number from 0 to 1");
  EXPECT_EQ(parsed(R"({"meniscus_scene": 1, "look": {"depth_cue": 1}})"), MENISCUS_OK);

  const Renderer draws = renderer(MENISCUS_CPU);
  std::vector<std::uint8_t> rgba(4);
  const auto draw = [&](const SceneOf& of) {
    return meniscus_render_scene(draws.get(), of.get(), rgba.data(), rgba.size());
  };
  EXPECT_EQ(draw(scene_with({{"size", "1x1"}})), MENISCUS_USAGE);
  EXPECT_NE(said().find("no molecule"), std::string::npos) << said();
  EXPECT_EQ(draw(scene_with({{"size", "1x1"}, {"file", "a.pdb"}, {"frames", "all"}})), MENISCUS_USAGE);
  EXPECT_NE(said().find("frames"), std::string::npos) << said();
  EXPECT_EQ(draw(scene_with({{"size", "1x1"}, {"file", "a.pdb"}, {"color_range", "0:1"}})), MENISCUS_USAGE);
  EXPECT_TRUE(said().starts_with("color_range: ")) << said();
  EXPECT_EQ(draw(scene_with({{"size", "1x1"}, {"file", "/nowhere/a.pdb"}})), MENISCUS_INPUT);
  EXPECT_EQ(draw(scene_with({{"size", "2x1"}, {"file", "a.pdb"}})), MENISCUS_USAGE);
  EXPECT_NE(said().find("2x1 pixels need 8"), std::string::npos) << said();
}

TEST(CApiScenes, OfFilesLieBesideTheFilesThatTheyName) {
  const TemporaryFolder folder;
  folder.file("a.pdb", kMolecule);
  const std::string inside =
      folder.file("scene.json", R"({"meniscus_scene": 1, "molecule": {"file": "a.pdb"}, "image": {"size": "8x6"}})");
  meniscus_scene* read = nullptr;
  ASSERT_EQ(meniscus_scene_read(inside.c_str(), &read), MENISCUS_OK) << said();
  const SceneOf scene(read);
  EXPECT_EQ(value_of(scene, "file"), folder.path() / "a.pdb");
  EXPECT_NE(json_of(scene, folder.path().c_str()).find("\"file\": \"a.pdb\""), std::string::npos);
  EXPECT_EQ(drawn(scene).size(), 8u * 6 * 4);
  const std::string outside = folder.file("outside.json", R"({"meniscus_scene": 1, "molecule": {"file": "../a.pdb"}})");
  meniscus_scene* none = nullptr;
  EXPECT_EQ(meniscus_scene_read(outside.c_str(), &none), MENISCUS_INPUT);
  EXPECT_NE(said().find("outside of the scene's folder; parse the text"), std::string::npos) << said();
  EXPECT_EQ(meniscus_scene_read((folder.path() / "missing.json").c_str(), &none), MENISCUS_INPUT);
  EXPECT_EQ(none, nullptr);
}

TEST(CApiScenes, HaveThePicturesOfTheProgram) {
  const TemporaryFolder folder;
  const std::string molecule = folder.file("a.pdb", kMolecule), file = folder.path() / "scene.json",
                    picture = folder.path() / "a.png";
  const SceneOf scene = scene_with({{"file", molecule.c_str()},
                                    {"size", "240x180"},
                                    {"color", "chain"},
                                    {"legend", "true"},
                                    {"label", "resid 2=Gly 2"},
                                    {"scale_bar", "true"},
                                    {"panel", "A"},
                                    {"clip", "z<0.5"},
                                    {"sticks", "chain A"},
                                    {"silhouettes", "1.5"}});
  for (const char* const background : {"transparent", "#204060"}) {
    ASSERT_EQ(meniscus_scene_set(scene.get(), "background", background), MENISCUS_OK) << said();
    std::ofstream(file) << json_of(scene, folder.path().c_str());
    const ProgramResult made = run_program(
        test::meniscus_program(), {"render", "--scene", file, "-o", picture, "--force", "--device", "cpu", "--quiet"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const std::vector<std::uint8_t> ours = drawn(scene);
    const std::string again = folder.file("ours.rgba", {reinterpret_cast<const char*>(ours.data()), ours.size()});
    const ProgramResult compared = run_program(
        "/usr/bin/python3", {"-c",
                             "import sys, OpenImageIO as o\n"
                             "c = o.ImageSpec(); c.attribute('oiio:UnassociatedAlpha', 1)\n"
                             "p = o.ImageInput.open(sys.argv[1], c).read_image('uint8')\n"
                             "if p.shape[2] == 3:\n"
                             "  import numpy as n; p = n.dstack([p, n.full(p.shape[:2], 255, 'uint8')])\n"
                             "sys.exit(p.shape[:2] != (180, 240) or p.tobytes() != open(sys.argv[2], 'rb').read())",
                             picture, again});
    EXPECT_EQ(compared.exit_code, 0) << background << compared.err;
  }
}

}  // namespace
}  // namespace meniscus
