// SPDX-License-Identifier: BSD-3-Clause
// Scene files: a saved scene makes the same picture again, options override them, and errors name their places.
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <tuple>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

namespace meniscus {
namespace {

using test::ProgramResult;
using test::TemporaryFolder;

constexpr const char* kFarAtoms = "-4 0 0 1.7\n4 0 0 1.7\n";
constexpr const char* kCamera =
    R"({"position":[0,0,30],"target":[0,0,0],"up":[0,1,0],"projection":"orthographic","height":12})";

class SceneFile : public ::testing::Test {
 protected:
  ProgramResult run(const std::vector<std::string>& arguments) {
    return test::run_program(test::meniscus_program(), arguments);
  }
  ProgramResult render(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"--no-provenance", "-q"});
    return run(arguments);
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string bytes(const std::string& name) const { return test::read_bytes(path(name)); }

  TemporaryFolder folder_;
  std::string molecule_ = folder_.file("two.xyzr", kFarAtoms);
};

TEST_F(SceneFile, WhatIsSavedMakesTheSamePictureAgain) {
  const std::vector<std::string> options{
      molecule_,
      "--size=64x48",
      "--samples=2",
      "--color=red",
      "--color=index 1=blue",
      "--opacity=0.5",
      "--clip=y<1",
      "--clip=x>-5",
      "--film-opacity",
      "--turn=y30",
      "--turn=x-10",
      "--light=-1,2,3",
      "--preset=cover",
      "--background=white",
      "--scale-bar=2",
      "--label=all=it",
      "--cap-color=red",
      "--patches=index 1",
      "--min-patch=1",
      "--patch-lines=0.5pt",
      "--patch-line-color=red",
      "--probe=1.2",
      "--spheres=index 0",
      "--object",
      R"({"representation":"surface","selection":"index 1","color":"gold","specular":0.9,"probe":0.5})"};
  std::vector<std::string> first = options;
  first.insert(first.end(), {"-o", path("a.png"), "--save-scene", path("a.json")});
  const ProgramResult made = render(first);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const ProgramResult again = render({"--scene", path("a.json"), "-o", path("b.png")});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(bytes("a.png"), bytes("b.png"));
  // A scene that is saved again is equal, except for the picture's name.
  ASSERT_EQ(
      render({"--scene", path("a.json"), "-o", path("a.png"), "--force", "--save-scene", path("a2.json")}).exit_code,
      0);
  EXPECT_EQ(bytes("a.json"), bytes("a2.json"));
  const nlohmann::json scene = nlohmann::json::parse(bytes("a.json"));
  EXPECT_EQ(scene["molecule"]["file"], "two.xyzr");
  EXPECT_EQ(scene["objects"].size(), 3u);
  EXPECT_EQ(scene["look"]["light"], "-1,2,3");
  // The scene is rendered without further words, and from another folder.
  std::filesystem::remove(path("a.png"));
  ASSERT_EQ(run({path("a.json"), "--no-provenance", "-q"}).exit_code, 0);
  EXPECT_EQ(bytes("a.png"), bytes("b.png"));
}

// Version 0.1.0 wrote the number of an enumerator instead of the user's word.
TEST_F(SceneFile, ALinkInItsFolderKeepsItsName) {
  const TemporaryFolder elsewhere;
  std::filesystem::create_symlink(elsewhere.file("far.xyzr", kFarAtoms), path("near.xyzr"));
  ASSERT_EQ(render({path("near.xyzr"), "--size=32x24", "-o", path("a.png"), "--save-scene", path("a.json")}).exit_code,
            0);
  EXPECT_EQ(nlohmann::json::parse(bytes("a.json"))["molecule"]["file"], "near.xyzr");
  const ProgramResult again = render({"--scene", path("a.json"), "-o", path("b.png")});
  EXPECT_EQ(again.exit_code, 0) << again.err;
}

// In a link to a folder, ".." is the folder around its target, where another file may have the same name.
TEST_F(SceneFile, APathThroughALinkIsThatOfTheFileThatWasRead) {
  const TemporaryFolder elsewhere;
  const std::string far = elsewhere.file("two.xyzr", "0 0 0 3\n");
  std::filesystem::create_directory(elsewhere.path() / "inner");
  std::filesystem::create_directory_symlink(elsewhere.path() / "inner", path("link"));
  ASSERT_EQ(
      render({path("link/../two.xyzr"), "--size=32x24", "-o", path("a.png"), "--save-scene", path("a.json")}).exit_code,
      0);
  const std::string file = nlohmann::json::parse(bytes("a.json"))["molecule"]["file"];
  EXPECT_TRUE(std::filesystem::equivalent(folder_.path() / file, far)) << file;
}

TEST_F(SceneFile, HasWordsAsTheyWereGivenAndReadsTheNumbersOfVersion010) {
  const std::vector<std::string> options{molecule_, "--size=64x48", "--preset", "soft",         "--surface",
                                         "sas",     "--cavities",   "drop",     "--projection", "orthographic"};
  std::vector<std::string> first = options;
  first.insert(first.end(), {"-o", path("a.png"), "--save-scene", path("a.json")});
  const ProgramResult made = render(first);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  nlohmann::json scene = nlohmann::json::parse(bytes("a.json"));
  nlohmann::json& surface = scene["objects"][0];
  EXPECT_EQ(scene["look"]["preset"], "soft");
  EXPECT_EQ(scene["camera"]["projection"], "orthographic");
  EXPECT_EQ(surface["kind"], "sas");
  EXPECT_EQ(surface["cavities"], "drop");
  scene["look"]["preset"] = 3;
  scene["camera"]["projection"] = 1;
  surface["kind"] = 1;
  surface["cavities"] = 1;
  folder_.file("old.json", scene.dump());
  const ProgramResult again = render({"--scene", path("old.json"), "-o", path("b.png")});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(bytes("a.png"), bytes("b.png"));
  EXPECT_EQ(render({molecule_, "--preset", "9", "-o", path("c.png")}).exit_code, 2);
}

TEST_F(SceneFile, OptionsCountBeforeIt) {
  folder_.file("s.json", R"({"meniscus_scene":1,"molecule":{"file":"two.xyzr"},"image":{"size":"64x48","samples":1},
                             "surface_is_no_section":{}})");
  EXPECT_NE(render({"--scene", path("s.json"), "-o", path("x.png")}).err.find("surface_is_no_section"),
            std::string::npos);
  folder_.file("t.json", R"({"meniscus_scene":1,"molecule":{"file":"two.xyzr"},"image":{"size":"64x48","samples":1}})");
  ASSERT_EQ(render({"--scene", path("t.json"), "--size", "32x24", "-o", path("small.png")}).exit_code, 0);
  ASSERT_EQ(render({molecule_, "--size", "32x24", "--samples", "1", "-o", path("same.png")}).exit_code, 0);
  EXPECT_EQ(bytes("small.png"), bytes("same.png"));
  // Another molecule is drawn with the same scene.
  const std::string one = folder_.file("one.xyzr", "0 0 0 1.5\n");
  ASSERT_EQ(render({one, "--scene", path("t.json"), "-o", path("one.png")}).exit_code, 0);
  ASSERT_EQ(render({one, "--size", "64x48", "--samples", "1", "-o", path("one2.png")}).exit_code, 0);
  EXPECT_EQ(bytes("one.png"), bytes("one2.png"));
  const ProgramResult areas = run({"surface", "--scene", path("t.json"), "--csv", path("a.csv"), "-q"});
  EXPECT_EQ(areas.exit_code, 0) << areas.err;
  EXPECT_EQ(run({"surface", molecule_, "--csv", path("b.csv"), "-q"}).exit_code, 0);
  EXPECT_EQ(bytes("a.csv"), bytes("b.csv"));
}

TEST_F(SceneFile, PicturesCarryTheirs) {
  ASSERT_EQ(run({"render", molecule_, "--size", "40x30", "--color", "red", "-o", path("a.png"), "-q"}).exit_code, 0);
  EXPECT_NE(bytes("a.png").find("Meniscus scene"), std::string::npos);
  EXPECT_EQ(bytes("a.png").find(folder_.path().string()), std::string::npos);
  ASSERT_EQ(run({"render", "--scene", path("a.png"), "-o", path("b.png"), "-q"}).exit_code, 0);
  EXPECT_EQ(bytes("a.png"), bytes("b.png"));
  ASSERT_EQ(run({"render", molecule_, "--size", "40x30", "-o", path("c.png"), "--no-provenance", "-q"}).exit_code, 0);
  EXPECT_EQ(bytes("c.png").find("Meniscus"), std::string::npos);
  for (const char* name : {"d.tif", "d.exr"}) {
    ASSERT_EQ(run({"render", molecule_, "--size", "40x30", "-o", path(name), "-q"}).exit_code, 0);
    EXPECT_NE(bytes(name).find("\"meniscus_scene\": 1"), std::string::npos) << name;
  }
}

TEST_F(SceneFile, AFurtherSurfaceStandsWhereTheWholeHadIt) {
  const std::string camera = folder_.file("camera.json", kCamera);
  const std::vector<std::string> common{"--camera", camera,     "--size",  "96x72",   "--samples",
                                        "1",        "--preset", "classic", "--color", "orange"};
  const auto with = [&](std::vector<std::string> own) {
    own.insert(own.begin(), molecule_);
    own.insert(own.end(), common.begin(), common.end());
    return own;
  };
  ASSERT_EQ(render(with({"-o", path("both.png")})).exit_code, 0);
  const ProgramResult parted =
      render(with({"--select", "index 0", "--object", R"({"selection":"index 1"})", "-o", path("parted.png")}));
  ASSERT_EQ(parted.exit_code, 0) << parted.err;
  EXPECT_EQ(bytes("both.png"), bytes("parted.png"));
  // Each of these objects is visible.
  for (const char* own : {R"({"selection":"index 1","color":"blue"})", R"({"selection":"index 1","opacity":0.5})",
                          R"({"selection":"index 1","specular":1,"shininess":5})",
                          R"({"selection":"index 1","kind":"sas"})", R"({"selection":"index 1","clip":"y<0"})",
                          R"({"selection":"index 1","representation":"spheres","color":"blue"})"}) {
    const ProgramResult result =
        render(with({"--select", "index 0", "--object", own, "-o", path("own.png"), "--force"}));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(bytes("both.png"), bytes("own.png")) << own;
  }
  // Only the object is drawn.
  ASSERT_EQ(render(with({"--hide-surface", "--object", R"({"selection":"index 1"})", "-o", path("one.png")})).exit_code,
            0);
  ASSERT_EQ(render(with({"--select", "index 1", "-o", path("alone.png")})).exit_code, 0);
  EXPECT_EQ(bytes("one.png"), bytes("alone.png"));
}

// A pocket is shown without its ligand's surface: an atom that is not on the surface selects the atoms near it.
TEST_F(SceneFile, WhatIsShownMayBeNearWhatStandsBeside) {
  const std::string three = folder_.file("three.xyzr", "0 0 0 1.7\n3 0 0 1.7\n9 0 0 1.7\n");
  const auto picture = [&](const char* name, const std::vector<std::string>& own) {
    std::vector<std::string> all{
        three, "--select", "index 0 1", "--size", "64x48", "--camera", folder_.file("camera.json", kCamera),
        "-o",  path(name), "--force"};
    all.insert(all.end(), own.begin(), own.end());
    const ProgramResult result = render(all);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.exit_code == 0 ? bytes(name) : std::string();
  };
  EXPECT_EQ(picture("a.png", {"--spheres", "index 2", "--show", "within 7 of index 2"}),
            picture("b.png", {"--spheres", "index 2", "--show", "index 1"}));
}

// Numbers have the colours of the molecule's scale, which the legend shows, on all other objects.
TEST_F(SceneFile, ObjectsShareTheScaleOfTheMolecule) {
  const std::string numbered =
      folder_.file("numbered.pdb",
                   "ATOM      1  C   ALA A   1      -4.000   0.000   0.000  1.00 10.00           C\n"
                   "ATOM      2  C   ALA A   2       0.000   0.000   0.000  1.00 20.00           C\n"
                   "ATOM      3  C   ALA B   3       4.000   0.000   0.000  1.00 90.00           C\n"
                   "ATOM      4  C   ALA B   4       4.000   4.000   0.000  1.00 15.00           C\n");
  const auto picture = [&](const char* name, const std::vector<std::string>& own) {
    std::vector<std::string> all{numbered, "--select", "chain A",
                                 "--size", "64x48",    "--samples",
                                 "1",      "--camera", folder_.file("camera.json", kCamera),
                                 "-o",     path(name)};
    all.insert(all.end(), own.begin(), own.end());
    const ProgramResult result = render(all);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.exit_code == 0 ? bytes(name) : std::string();
  };
  const auto same = [&](const std::vector<std::string>& own) {
    std::vector<std::string> ranged = own;
    ranged.insert(ranged.end(), {"--color-range", "10:20", "--force"});
    const std::string automatic = picture("automatic.png", own);
    std::filesystem::remove(path("automatic.png"));
    return automatic == picture("ranged.png", ranged);
  };
  EXPECT_TRUE(same({"--color", "bfactor", "--object", R"({"selection":"chain B"})"}));
  EXPECT_TRUE(same({"--color", "bfactor", "--object", R"({"selection":"chain B","representation":"spheres"})"}));
  EXPECT_TRUE(same({"--color", "all=bfactor", "--object", R"({"selection":"chain B"})"}));
  EXPECT_TRUE(same({"--color", "all=bfactor", "--spheres", "chain B"}));
  EXPECT_NE(
      picture("narrow.png", {"--color", "bfactor", "--object", R"({"selection":"chain B"})"}),
      picture("wide.png", {"--color", "bfactor", "--color-range", "10:90", "--object", R"({"selection":"chain B"})"}));
  // Numbers that are measured for the surface's atoms alone are missing for others.
  picture("buried.png", {"--color", "buried", "--by", "residue", "--spheres", "chain B"});
  // With one colour per number, other atoms would get colours that the legend lacks.
  const ProgramResult classes = render({numbered, "--select", "chain A", "--color", "bfactor", "--map", "categorical",
                                        "--spheres", "chain B", "-o", path("classes.png")});
  EXPECT_EQ(classes.exit_code, 2) << classes.err;
  EXPECT_NE(classes.err.find("--map categorical"), std::string::npos) << classes.err;
}

TEST_F(SceneFile, FaultsAreNamed) {
  int n = 0;
  for (
      const auto& [text, why, code] :
      {std::tuple{"{", "not JSON", 3},
       {"[]", "is not a scene", 3},
       {R"({"molecule":{"file":"two.xyzr"}})", "is not a scene", 3},
       {R"({"meniscus_scene":2})", "reads version 1", 3},
       {R"({"meniscus_scene":1})", "molecule.file is missing", 3},
       {R"({"meniscus_scene":1,"molecule":{"file":"two.xyzr","selcet":"all"}})", "did you mean select", 3},
       {R"({"meniscus_scene":1,"molecule":{"file":"two.xyzr"},"imgae":{}})", "did you mean image", 3},
       {R"({"meniscus_scene":1,"molecule":{"file":"two.xyzr","keep_water":"yes"}})", "neither true nor false", 3},
       {R"({"meniscus_scene":1,"molecule":{"file":7}})", "molecule.file is not a path", 3},
       {R"({"meniscus_scene":1,"molecule":{"file":"two.xyzr"},"image":{"size":"big"}})",
        "image.size: 'big' is not WIDTHxHEIGHT", 2},
       {R"({"meniscus_scene":1,"molecule":{"file":"two.xyzr","select":"chain"}})",
        "molecule.select: a value is missing", 2},
       {R"({"meniscus_scene":1,"molecule":{"file":"two.xyzr"},"objects":{}})", "not a JSON list", 3},
       {R"({"meniscus_scene":1,"molecule":{"file":"two.xyzr"},"objects":[{"clip":"q<1"}]})",
        "objects[0].clip: 'q<1' is not a plane", 2},
       {R"({"meniscus_scene":1,"molecule":{"file":"two.xyzr"},"objects":[{"representation":"cartoon","selection":"all"}]})",
        "not one of surface, sticks", 2},
       {R"({"meniscus_scene":1,"molecule":{"file":"two.xyzr"},"objects":[{"representation":"sticks","selection":"all","clip":"x<1"}]})",
        "is not a key of sticks", 2},
       {R"({"meniscus_scene":1,"molecule":{"file":"gone.xyzr"}})", "gone.xyzr", 3}}) {
    const std::string scene = folder_.file("bad" + std::to_string(n++) + ".json", text);
    const ProgramResult result = render({"--scene", scene, "-o", path("bad.png")});
    EXPECT_EQ(result.exit_code, code) << text << result.err;
    EXPECT_NE(result.err.find(why), std::string::npos) << text << result.err;
    EXPECT_FALSE(std::filesystem::exists(path("bad.png")));
  }
  EXPECT_NE(run({"info", "--scene", path("bad0.json")}).err.find("has no option '--scene'"), std::string::npos);
  const std::string cut =
      folder_.file("cut.json", R"({"meniscus_scene":1,"molecule":{"file":"two.xyzr"},"objects":[{"clip":"x<1"}]})");
  const ProgramResult refused = run({"export", "ply", "--scene", cut, "-o", path("cut.ply")});
  EXPECT_EQ(refused.exit_code, 2) << refused.err;
  EXPECT_NE(refused.err.find("objects[0].clip"), std::string::npos) << refused.err;
  const std::string outlined = folder_.file(
      "outlined.json", R"({"meniscus_scene":1,"molecule":{"file":"two.xyzr"},"objects":[{"patches":"index 1"}]})");
  const ProgramResult lines = run({"export", "povray", "--scene", outlined, "-o", path("outlined")});
  EXPECT_EQ(lines.exit_code, 2) << lines.err;
  EXPECT_NE(lines.err.find("cannot show that (--patches); leave it out of the scene, or choose render"),
            std::string::npos)
      << lines.err;
}

// An option that is in neither list would be lost when a scene is saved.
TEST_F(SceneFile, EveryOptionOfAPictureIsInScenesOrNamedAsLeftOut) {
  const std::set<std::string> beside{
      "--device",        "--force",       "--help",  "--help-all", "--jobs",        "--only",
      "--progress",      "--provenance",  "--quiet", "--verbose",  "--require-gpu", "--save-camera",
      "--save-scene",    "--scene",       "--set",   "--threads",  "--verify",      "--warnings",
      "--no-provenance", "--trust-scene", "--draft", "--resume",   "--look-into"};  // is saved as what it stands for
  const std::string scenes = run({"help", "scenes"}).out;
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"render", "--help-all"}, {"export", "povray", "--help-all"}, {"export", "blender", "--help-all"}}) {
    const std::string help = run(command).out;
    const std::regex option(R"(\n  (?:-\w,)?(--[a-z-]+))");
    int count = 0;
    for (std::sregex_iterator found(help.begin(), help.end(), option), end; found != end; ++found, ++count) {
      const std::string name = (*found)[1];
      if (beside.contains(name) || name == "--output" || name == "--object") continue;
      const bool shape = name == "--sticks" || name == "--balls" || name == "--spheres" || name == "--tube" ||
                         name == "--bases" || name == "--glycans" || name == "--hydrogen-bonds" || name == "--distance";
      EXPECT_TRUE(shape || std::regex_search(scenes, std::regex(" " + name + "\n"))) << name;
    }
    EXPECT_GT(count, 40);
  }
}

TEST_F(SceneFile, TheSchemaInTheTreeIsTheProgramsOwn) {
  EXPECT_EQ(run({"help", "--scene-schema"}).out,
            test::read_bytes(test::test_file("../docs/reference/scene.schema.json")));
}

}  // namespace
}  // namespace meniscus
