// SPDX-License-Identifier: BSD-3-Clause
// Files that options name are read before anything is computed, and results that only look right are reported: atoms in
// another order, pictures that show nothing.
#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

namespace meniscus::test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

/// Returns two residues, in models that drift along x; `reversed`: atoms in the opposite order.
std::string dipeptide(int models, bool reversed = false) {
  const char* names[] = {"N", "CA", "C", "O", "CB"};
  const double sites[][3] = {{0, 0, 0}, {1.46, 0, 0}, {2.0, 1.42, 0}, {1.25, 2.39, 0}, {2.0, -0.8, -1.2}};
  std::string text;
  for (int model = 0; model < models; ++model) {
    std::vector<std::string> lines;
    for (int n = 0; n < 10; ++n) {
      const double* site = sites[n % 5];
      const double x = n < 5 ? site[0] : 3.33 + site[1] / 2.0, y = n < 5 ? site[1] : 1.5 + site[0];
      lines.push_back(
          fmt::format("ATOM  {:>5}  {:<3} ALA A{:>4}    {:>8.3f}{:>8.3f}{:>8.3f}  1.00 10.00           {}\n", n + 1,
                      names[n % 5], n / 5 + 1, x + 30.0 * model, y, site[2], names[n % 5][0]));
    }
    if (reversed) std::ranges::reverse(lines);
    text += fmt::format("MODEL     {:>4}\n", model + 1);
    for (const std::string& line : lines) text += line;
    text += "ENDMDL\n";
  }
  return text;
}

std::string camera(const char* position, const char* target) {
  return fmt::format(R"({{"position":[{}],"target":[{}],"up":[0,1,0],"projection":"perspective","vertical_fov":30}})",
                     position, target);
}

class NamedFiles : public ::testing::Test {
 protected:
  ProgramResult meniscus(Words words, const Words& more = {}) {
    words.insert(words.end(), more.begin(), more.end());
    return run_program(meniscus_program(), words);
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  TemporaryFolder folder_;
  std::string molecule_ = folder_.file("two.pdb", dipeptide(2));
};

TEST_F(NamedFiles, ABadCameraEndsTheProgramBeforeTheMoleculeIsRead) {
  const std::string bad = folder_.file("bad.json", R"({"position":[0,0,0]})");
  const Words commands[] = {{"render", "-o", path("a.png"), "--camera"},
                            {"render", "-o", path("a.png"), "--extent", "visible", "--camera"},
                            {"render", "-o", path("a_#.png"), "--frames", "all", "--camera"},
                            {"render", "-o", path("a_#.png"), "--frames", "all", "--camera-path"},
                            {"export", "ply", "-o", path("a.ply"), "--tolerance-pixels", "1", "--camera"},
                            {"export", "povray", "-o", path("pov"), "--camera"},
                            {"export", "povray", "-o", path("pov"), "--frames", "all", "--camera-path"},
                            {"export", "blender", "-o", path("a.mns"), "--camera"},
                            {"export", "blender", "-o", path("mns"), "--frames", "all", "--camera"},
                            {"preview", "--serve", "--camera"}};
  for (const Words& command : commands) {
    const ProgramResult result = meniscus(command, {bad, molecule_});
    EXPECT_EQ(result.exit_code, 3) << command[0] << ' ' << command[1] << ": " << result.err;
    EXPECT_NE(result.err.find("bad.json"), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("atoms read"), std::string::npos)
        << command[0] << ' ' << command[1] << ": " << result.err;
  }
  EXPECT_EQ(folder_.entries(), (Words{"bad.json", "two.pdb"}));
}

TEST_F(NamedFiles, NumbersAndPartsAreCheckedBeforeTheSurfaceIsComputed) {
  // The missing device is requested only when a surface is computed.
  const Words command{"render", molecule_, "-o", path("a.png"), "--device", "gpu:77"};
  EXPECT_EQ(meniscus(command).exit_code, 4);
  const std::string few = folder_.file("few.txt", "1 2 3\n");
  const ProgramResult numbers = meniscus(command, {"--color-by-file", few});
  EXPECT_EQ(numbers.exit_code, 3) << numbers.err;
  EXPECT_NE(numbers.err.find("few.txt: holds 3 numbers"), std::string::npos) << numbers.err;
  const ProgramResult charges = meniscus(command, {"--color", "charge"});
  EXPECT_EQ(charges.exit_code, 3) << charges.err;
  const ProgramResult nobody = meniscus(command, {"--show", "chain Z"});
  EXPECT_EQ(nobody.exit_code, 3) << nobody.err;
}

TEST_F(NamedFiles, PicturesOfNothingSaySo) {
  const std::string away = folder_.file("away.json", camera("0,0,50", "0,0,99")),
                    close = folder_.file("close.json", camera("4.0,2.5,30", "4.0,2.5,0"));
  const auto warns = [&](const Words& more) {
    const ProgramResult result = meniscus({"render", molecule_, "--force", "-o", path("a.png"), "--size"}, more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_GT(read_bytes(path("a.png")).size(), 60u);
    return result.err.find("warning: the picture shows nothing") != std::string::npos;
  };
  EXPECT_FALSE(warns({"40x30"}));
  EXPECT_FALSE(warns({"40x30", "--camera", close}));
  EXPECT_TRUE(warns({"40x30", "--camera", away}));
  EXPECT_TRUE(warns({"40x30", "--camera", away, "--extent", "visible", "--background", "white"}));
  EXPECT_TRUE(warns({"640x480", "--camera", away, "--legend", "--color", "chain"}));
  // The camera looks closely at atoms that --show hides.
  const std::string narrow = folder_.file(
      "narrow.json", R"({"position":[0,0,50],"target":[0,0,0],"up":[0,1,0],"projection":"orthographic","height":0.5})");
  EXPECT_FALSE(warns({"40x30", "--camera", narrow}));
  EXPECT_TRUE(warns({"40x30", "--camera", narrow, "--show", "resid 2"}));
  EXPECT_FALSE(warns({"40x30", "--camera", away, "-q"}));
}

TEST_F(NamedFiles, OneLineForAllPicturesOfARunThatShowNothing) {
  const std::string file = folder_.file("drift.pdb", dipeptide(4)),
                    first = folder_.file("first.json", camera("2,1,40", "2,1,0"));  // 30 Å show the first frame only
  const ProgramResult result = meniscus({"render", file, "--frames", "all", "--camera", first, "--size", "40x40", "-o",
                                         path("f_#.png"), "--progress", "json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  std::istringstream lines(result.err);
  std::vector<int> empty;
  int warnings = 0;
  for (std::string line; std::getline(lines, line);) {
    warnings += line.find("3 of the pictures show nothing (first: frame 1)") != std::string::npos ? 1 : 0;
    if (!line.starts_with('{')) continue;
    const Json json = Json::parse(line);
    if (json.value("empty", false)) empty.push_back(json["frame"]);
  }
  EXPECT_EQ(warnings, 1) << result.err;
  EXPECT_EQ(empty, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(meniscus({"render", file, "--frames", "0", "--camera", first, "--size", "40x40", "-o", path("g_#.png")})
                .err.find("nothing"),
            std::string::npos);
}

TEST_F(NamedFiles, ATrajectoryInAnotherOrderIsRefused) {
  const std::string right = folder_.file("right.pdb", dipeptide(2)),
                    wrong = folder_.file("wrong.pdb", dipeptide(2, true));
  const Words command{"surface", molecule_, "--json", "--trajectory"};
  EXPECT_EQ(meniscus(command, {right}).exit_code, 0);
  const ProgramResult refused = meniscus(command, {wrong, "--frames", "1"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(refused.out, "");
  EXPECT_NE(refused.err.find("wrong.pdb: frame 1: "), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("in another order"), std::string::npos) << refused.err;
  EXPECT_EQ(meniscus(command, {wrong, "--trust-atom-order"}).exit_code, 0);
}

TEST_F(NamedFiles, ATrajectoryOfFewerAtomsNamesTheClassesThatFit) {
  std::string solvated = dipeptide(1);
  solvated.resize(solvated.find("ENDMDL"));
  for (int n = 0; n < 3; ++n)
    solvated += fmt::format("HETATM   2{}  O   HOH W {:>3}    {:>8.3f}   9.000   9.000  1.00 10.00           O\n", n, n,
                            4.0 * n);
  const ProgramResult result = meniscus(
      {"surface", folder_.file("solvated.pdb", solvated), "--trajectory", folder_.file("dry.pdb", dipeptide(2))});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("its frames have 10 atoms, "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("solvated.pdb has 13: as many as it has without water"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace meniscus::test
