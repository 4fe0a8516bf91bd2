// SPDX-License-Identifier: BSD-3-Clause
// Several molecules in one figure: files that are added, superposed, and distinguished as models.
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/cli/walking_atoms.h"
#include "tests/support/sample_files.h"

namespace meniscus::test {
namespace {

using Json = nlohmann::json;

/// Returns the file with its atoms turned about z and moved, with the rounding of PDB.
std::string turned(const std::string& pdb, double angle, double shift) {
  std::string text;
  std::size_t begin = 0;
  while (begin < pdb.size()) {
    const std::size_t end = std::min(pdb.find('\n', begin), pdb.size());
    std::string line = pdb.substr(begin, end - begin);
    begin = end + 1;
    if (line.starts_with("ATOM") || line.starts_with("HETATM")) {
      const double x = std::stod(line.substr(30, 8)), y = std::stod(line.substr(38, 8)),
                   z = std::stod(line.substr(46, 8));
      line.replace(30, 24,
                   fmt::format("{:8.3f}{:8.3f}{:8.3f}", x * std::cos(angle) - y * std::sin(angle) + shift,
                               x * std::sin(angle) + y * std::cos(angle), z));
    }
    text += line + "\n";
  }
  return text;
}

Json surface(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"surface", "--json", "-q", "--device", "cpu"});
  const ProgramResult result = meniscus(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return Json::parse(result.out, nullptr, false);
}

class AddedFiles : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  TemporaryFolder folder_;
  std::string moved_ = folder_.file("moved.pdb", turned(read_bytes(kUbiquitin), 1.0, 300.0));
};

TEST_F(AddedFiles, AreModelsWithSurfacesOfTheirOwn) {
  const Json one = surface({kToxin}), other = surface({moved_});
  const Json both = surface({kToxin, "--add", moved_, "--by", "model"});
  EXPECT_NEAR(both["area"], one["area"].get<double>() + other["area"].get<double>(), 1e-6);
  EXPECT_NEAR(both["volume"], one["volume"].get<double>() + other["volume"].get<double>(), 1e-6);
  EXPECT_EQ(both["atoms"]["used"], one["atoms"]["used"].get<int>() + other["atoms"]["used"].get<int>());
  EXPECT_EQ(both["atoms"]["read"], one["atoms"]["read"].get<int>() + other["atoms"]["read"].get<int>());
  EXPECT_EQ(both["added"], Json::array({{{"file", moved_}, {"model", 2}, {"atoms", 660}}}));
  // Molecules so far apart have the same surface without the division, too.
  EXPECT_NEAR(surface({kToxin, "--add", moved_})["area"], both["area"].get<double>(), 1e-6);
  EXPECT_EQ(surface({kToxin, "--add", moved_, "--select", "model 2"})["area"], other["area"]);
  EXPECT_EQ(surface({kToxin, "--add", moved_, "--select", "not model 2"})["area"], one["area"]);
}

TEST_F(AddedFiles, AreSuperposedOnTheFirst) {
  const Json both = surface({kUbiquitin, "--add", moved_, "--superpose-on", "name CA", "--by", "model"});
  const Json& fit = both["added"][0]["superposition"];
  EXPECT_EQ(fit["atoms"], 76);
  EXPECT_LT(fit["rmsd"], 1e-3);
  EXPECT_NEAR(fit["matrix"][0][0], std::cos(1.0), 1e-4);
  EXPECT_NEAR(fit["matrix"][1][0], -std::sin(1.0), 1e-4);
  EXPECT_NEAR(fit["matrix"][0][3], -300.0 * std::cos(1.0), 0.02);
  // Molecules in the same place, except for PDB's rounding, fill no more room than one of them.
  const double alone = surface({kUbiquitin})["volume"];
  EXPECT_NEAR(surface({kUbiquitin, "--add", moved_, "--superpose-on", "name CA"})["volume"], alone, 0.001 * alone);
  const ProgramResult said = meniscus({"surface", kUbiquitin, "--add", moved_, "--superpose-on", "name CA"});
  EXPECT_NE(said.err.find("moved.pdb is model 2, superposed on the first file by 76 atoms with an RMSD of 0.00"),
            std::string::npos)
      << said.err;
}

TEST_F(AddedFiles, AreInEveryDoorOfAScene) {
  const std::vector<std::string> figure{"--add",    moved_,         "--superpose-on", "name CA",
                                        "--select", "model 1",      "--sticks",       "model 2 and name N CA C O",
                                        "--color",  "model",        "--legend",       "--size",
                                        "300x200",  "--trust-scene"};
  std::vector<std::string> arguments{"render", kUbiquitin, "-o", path("a.png"), "--save-scene", path("scene.json")};
  arguments.insert(arguments.end(), figure.begin(), figure.end());
  const ProgramResult first = meniscus(arguments);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const Json scene = Json::parse(read_bytes(path("scene.json")));
  EXPECT_EQ(scene["molecule"]["add"], Json::array({"moved.pdb"}));
  EXPECT_EQ(scene["molecule"]["superpose_on"], "name CA");
  EXPECT_EQ(scene["superposed"][0]["file"], "moved.pdb");
  EXPECT_EQ(scene["superposed"][0]["atoms"], 76);
  EXPECT_LT(scene["superposed"][0]["rmsd"], 1e-3);
  EXPECT_NE(read_bytes(path("a.png")).find("\"superposed\""), std::string::npos);
  const ProgramResult again =
      meniscus({"render", "--scene", path("scene.json"), "--trust-scene", "-o", path("b.png"), "-q"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const std::string pixels = read_bytes(path("a.png"));
  EXPECT_EQ(pixels.substr(pixels.find("IDAT")), read_bytes(path("b.png")).substr(pixels.find("IDAT")));
}

TEST_F(AddedFiles, OfMoleculesSayThatTheFirstIsAdded) {
  const std::string one =
      "lig\n  test    01012600003D\n\n  1  0  0  0  0  0  0  0  0  0999 V2000\n    0.0000    0.0000    0.0000 C   0  "
      "0\n"
      "M  END\n$$$$\n";
  const ProgramResult result = meniscus({"surface", kUbiquitin, "--add", folder_.file("two.sdf", one + one)});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("two.sdf: 2 molecules are in the file, and the first is added"), std::string::npos)
      << result.err;
  EXPECT_EQ(result.err.find("--model 2"), std::string::npos) << result.err;
}

TEST_F(AddedFiles, HaveNoPotentialInCommonWithSurfacesOfTheirOwn) {
  const std::vector<std::string> both{"render",         kUbiquitin, "--add",   moved_,
                                      "--superpose-on", "name CA",  "--color", "lipophilicity",
                                      "--by",           "model",    "-o",      path("a.png")};
  const ProgramResult result = meniscus(both);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("--color lipophilicity sums over the atoms of all models"), std::string::npos)
      << result.err;
}

TEST_F(AddedFiles, FollowTheFramesOfARun) {
  const std::string walking = folder_.file("walk.pdb", walk(4));
  const std::string still = folder_.file("still.pdb", walk(1));
  const ProgramResult result = meniscus({"surface", walking, "--frames", "all", "--json", "-q", "--add", still,
                                         "--superpose-on", "index 0 1 2", "--by", "model"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::istringstream lines(result.out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const Json frame = Json::parse(line);
    EXPECT_EQ(frame["added"][0]["superposition"]["atoms"], 3);
    EXPECT_LT(frame["added"][0]["superposition"]["rmsd"], 2e-3);
  }
  EXPECT_EQ(count, 4);
}

TEST_F(AddedFiles, WhatCannotBeIsRefused) {
  const auto refused = [&](std::vector<std::string> options, int exit_code, const std::string& words) {
    options.insert(options.begin(), {"surface", kUbiquitin});
    const ProgramResult result = meniscus(options);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  };
  refused({"--add", path("none.pdb")}, 3, "none.pdb");
  refused({"--superpose-on", "name CA"}, 2, "--add");
  refused({"--add", moved_, "--superpose-on", "name ZZ"}, 3,
          "has no chain that corresponds to one of /usr/share/freesasa/test-data/1ubq.pdb by its sequence");
  refused({"--add", kToxin, "--superpose-on", "name CA"}, 3, "1tii.pdb: has no chain that corresponds");
  refused({"--add", moved_, "--superpose-on", "radius > 1.5"}, 3, "has no radii yet");
  refused({"--add", folder_.file("own.xyzr", "0 0 0 1.5\n"), "--select", "all"}, 3, "has radii of its own");
  refused({"--add", folder_.file("own.pqr", "ATOM 1 C LIG 1 0 0 0 0.1 1.7\n")}, 3, "has radii of its own");
  refused({"--add", moved_, "--assembly", "1"}, 2, "--add and --assembly cannot be combined");
  refused({"--add", moved_, "--frames", "all", "--select-once", "--select", "x > 0"}, 2, "--select-once and --add");
}

}  // namespace
}  // namespace meniscus::test
