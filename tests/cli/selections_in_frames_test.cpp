// SPDX-License-Identifier: BSD-3-Clause
// Selections by places of atoms are evaluated in each frame of a run; --select-once keeps those of the first frame.
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/walking_atoms.h"

namespace meniscus::test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

/// Returns frames of an alanine and of three waters in separate chains; in frame n, water n is near the alanine, and in
/// the last frame none is.
std::string waters_that_come_and_go() {
  std::string text;
  for (int frame = 0; frame < 4; ++frame) {
    int serial = 0;
    text += fmt::format("MODEL     {:>4}\n", frame + 1);
    const auto atom = [&](const char* record, const char* name, const char* residue, char chain, int number, double x,
                          double y, double z, const char* element) {
      text += fmt::format("{:<6}{:>5} {:<4} {:<3} {}{:>4}    {:>8.3f}{:>8.3f}{:>8.3f}  1.00{:>6.2f}          {:>2}\n",
                          record, ++serial, name, residue, chain, number, x, y, z, 10.0 * number, element);
    };
    atom("ATOM", " N", "ALA", 'P', 1, -0.5, 1.4, 0, "N");
    atom("ATOM", " CA", "ALA", 'P', 1, 0, 0, 0.01 * frame, "C");
    atom("ATOM", " C", "ALA", 'P', 1, 1.5, 0, 0, "C");
    atom("ATOM", " O", "ALA", 'P', 1, 2.1, 1.0, 0, "O");
    atom("ATOM", " CB", "ALA", 'P', 1, -0.5, -0.8, -1.2, "C");
    for (int water = 0; water < 3; ++water)
      atom("HETATM", " O", "HOH", static_cast<char>('A' + water), 1 + water, water == frame ? 0.5 : 15.0 + 4 * water,
           -3.0, water, "O");
    text += "ENDMDL\n";
  }
  return text + "END\n";
}

const std::string kShell = "protein or (water and within 4 of protein)";

class SelectionsInFrames : public ::testing::Test {
 protected:
  Words with(Words first, const Words& more) {
    first.insert(first.end(), more.begin(), more.end());
    return first;
  }
  std::vector<Json> surface(const Words& more) {
    const ProgramResult result = meniscus(with({"surface", file_, "--json", "-q", "--device", "cpu"}, more));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::vector<Json> found;
    if (result.out.starts_with("{\n")) return {Json::parse(result.out)};
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) found.push_back(Json::parse(line));
    return found;
  }
  void expect_refused(const Words& words, const std::string& sentence) {
    const ProgramResult result = meniscus(words);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find(sentence), std::string::npos) << result.err;
  }
  std::string picture(const std::string& name, const Words& more) {
    const std::string path = (folder_.path() / name).string();
    const ProgramResult result = meniscus(with({"render", file_, "-q", "--device", "cpu", "--size", "64x48",
                                                "--samples", "1", "--no-provenance", "--camera", camera_, "-o", path},
                                               more));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return path;
  }

  TemporaryFolder folder_;
  std::string file_ = folder_.file("shell.pdb", waters_that_come_and_go());
  std::string camera_ = folder_.file(
      "camera.json",
      R"({"position": [0, 0, 40], "target": [0, -1, 0], "up": [0, 1, 0], "projection": "perspective", "vertical_fov": 20})");
};

TEST_F(SelectionsInFrames, AtomsAreThoseOfEachFrame) {
  const std::vector<Json> run = surface({"--select", kShell, "--frames", "all"});
  ASSERT_EQ(run.size(), 4u);
  for (int n = 0; n < 4; ++n) {
    const Json model = surface({"--select", kShell, "--model", std::to_string(n + 1)}).at(0);
    EXPECT_EQ(run[n]["atoms"]["used"], n < 3 ? 6 : 5) << n;
    EXPECT_EQ(run[n]["area"], model["area"]) << n;
    EXPECT_EQ(run[n]["volume"], model["volume"]) << n;
    // A share of the run has the results of the run.
    const Json share = surface({"--select", kShell, "--frames", "all", "--only", std::to_string(n)}).at(0);
    EXPECT_EQ(share["area"], run[n]["area"]) << n;
  }
  const std::vector<Json> coordinates = surface({"--select", "x < 2", "--keep-water", "--frames", "all"});
  EXPECT_EQ(coordinates[0]["atoms"]["used"], 5);  // all atoms but an oxygen, and a water
  EXPECT_EQ(coordinates[3]["atoms"]["used"], 4);
}

TEST_F(SelectionsInFrames, OnceAreThoseOfTheFirst) {
  const std::vector<Json> once = surface({"--select", kShell, "--frames", "1-3", "--select-once"});
  const std::vector<Json> second = surface({"--select", "protein or chain B", "--keep-water", "--frames", "1-3"});
  ASSERT_EQ(once.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n) {
    EXPECT_EQ(once[n]["atoms"]["used"], 6) << n;
    EXPECT_EQ(once[n]["area"], second[n]["area"]) << n;
  }
  expect_refused({"surface", file_, "--frames", "all", "--select", "protein", "--select-once"}, "--select-once");
}

TEST_F(SelectionsInFrames, ContextIsThatOfEachFrame) {
  const Words words{"--select", "protein", "--context", "water and within 4 of protein"};
  const std::vector<Json> run = surface(with(words, {"--frames", "0-2"}));
  for (int n = 0; n < 3; ++n) {
    const Json model = surface(with(words, {"--model", std::to_string(n + 1)})).at(0);
    EXPECT_EQ(run[n]["sas_area_buried"], model["sas_area_buried"]) << n;
    EXPECT_GT(run[n]["sas_area_buried"], 1.0) << n;
  }
}

TEST_F(SelectionsInFrames, PicturesShowEachFrameAsItIs) {
  for (const Words& words : {Words{"--spheres", "water and within 4 of protein"},
                             {"--balls", "water and within 4 of protein"},
                             {"--select", kShell, "--color", "element"},
                             {"--color", "within 3.7 of resname HOH=red", "--select", kShell},
                             {"--opacity", "z > 0.005=0.3"},
                             {"--show", "z > 0.005 or name N"}}) {
    const std::string run = picture("run_#.png", with(words, {"--frames", "0-2", "--force"}));
    for (const char* n : {"0", "2"}) {
      const std::string model = picture("model.png", with(words, {"--model", std::to_string(*n - '0' + 1), "--force"}));
      EXPECT_EQ(read_bytes(folder_.path() / fmt::format("run_{}.png", n)), read_bytes(model)) << words[1] << ' ' << n;
    }
    EXPECT_NE(read_bytes(folder_.path() / "run_0.png"), read_bytes(folder_.path() / "run_2.png")) << words[1];
  }
  // A frame with nothing to draw is not an error of the run.
  picture("last_#.png", {"--spheres", "water and within 4 of protein", "--frames", "all"});
}

// A chain and a number have one colour in all frames, whatever other atoms there are.
TEST_F(SelectionsInFrames, ColorsAreThoseOfTheRun) {
  for (const char* color : {"chain", "bfactor"}) {
    const Words words{"--select", kShell, "--color", color, "--frames", "0-2", "--force"};
    const std::string folder = (folder_.path() / "run").string();
    const ProgramResult result = meniscus(with({"export", "blender", file_, "-q", "-o", folder}, words));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json key = Json::parse(read_bytes(folder_.path() / "run" / "surface_sequence.json"))["colors"];
    if (color == std::string("chain")) {
      EXPECT_EQ(key["classes"].size(), 4u) << key;  // the chains P, A, B, C
    } else {
      EXPECT_EQ(key["range"], Json::parse("[10.0, 30.0]")) << key;
    }
  }
}

TEST_F(SelectionsInFrames, WhatNeedsTheSameAtomsNamesTheWayOut) {
  const std::string out = (folder_.path() / "out").string();
  const Words run{"--frames", "all", "--select", kShell};
  expect_refused(with({"export", "atoms", file_, "-q", "-o", out}, run), "--select-once");
  expect_refused(with({"render", file_, "-q", "-o", out + "_#.png", "--color", "rmsf"}, run), "--select-once");
  expect_refused(with({"render", file_, "-q", "-o", out + "_#.png", "--color", "index", "--map", "categorical"}, run),
                 "--select-once");
  const ProgramResult atoms =
      meniscus(with({"export", "atoms", file_, "-q", "-o", out + ".atoms", "--select-once"}, run));
  EXPECT_EQ(atoms.exit_code, 0) << atoms.err;
}

}  // namespace
}  // namespace meniscus::test
