// SPDX-License-Identifier: BSD-3-Clause
// Options that choose what is read from a file, and standard input, as users give them.
#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"
#include "tests/support/pdb_line.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

using test::PdbLine;
using test::ProgramResult;
using test::run_program;
using test::TemporaryFolder;

constexpr const char* kNmrEntry = "/usr/share/freesasa/test-data/1d3z.pdb";

ProgramResult run_shell(const std::string& command) {
  return run_program("/bin/sh", {"-c", command + " | " + test::meniscus_program() + " surface - --device cpu"});
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(StandardInput, IsReadPlainAndPacked) {
  for (const char* command : {"cat ", "gzip -c "}) {
    const ProgramResult result = run_shell(std::string(command) + kUbiquitin);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(result.err.starts_with("meniscus: standard input: 660 atoms read; 58 water atoms left out; 602 used\n"))
        << result.err;
    EXPECT_NE(result.out.find("standard input (PDB)"), std::string::npos) << result.out;
  }
}

TEST(StandardInput, ErrorsNameIt) {
  EXPECT_EQ(run_shell("printf ''").err, "meniscus: error: standard input: is empty: no atoms\n");
  const ProgramResult result = run_shell("printf '2\\n\\nC 0 0 0\\nC 1 x 1\\n'");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_TRUE(result.err.starts_with("meniscus: error: standard input:4: coordinate y is 'x'")) << result.err;
}

TEST(Model, IsChosenByItsPlace) {
  const ProgramResult second =
      run_program(test::meniscus_program(), {"surface", kNmrEntry, "--model", "2", "--device", "cpu"});
  EXPECT_NE(second.err.find("12,310 atoms read; 11,079 in other models left out; 1,231 used"), std::string::npos);
  const ProgramResult none = run_program(test::meniscus_program(), {"surface", kNmrEntry, "--model", "11"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_EQ(none.err, fmt::format("meniscus: error: {}: has no model 11: it holds 10 models; choose --model 1 to 10\n",
                                  kNmrEntry));
  for (const char* wrong : {"0", "-1", "1.5", "some", "99999999999"}) {
    const ProgramResult result = run_program(test::meniscus_program(), {"surface", kNmrEntry, "--model", wrong});
    EXPECT_EQ(result.exit_code, 2) << wrong;
    EXPECT_EQ(lines_of(result.err), 1u);
  }
}

TEST(Model, AllAreOneMolecule) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.xyz", "1\n\nC 0 0 0\n1\n\nC 50 0 0\n");
  const ProgramResult result =
      run_program(test::meniscus_program(), {"surface", path, "--model", "all", "--json", "--device", "cpu"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("2 atoms read; none left out; 2 used"), std::string::npos) << result.err;
}

TEST(Altloc, TakesARuleOrALetter) {
  const TemporaryFolder folder;
  const PdbLine a{.altloc = 'A', .occupancy = "  0.40"}, b{.altloc = 'B', .x = "   5.000", .occupancy = "  0.60"};
  const std::string path = folder.file("a.pdb", a.text() + b.text());
  const auto run = [&](const std::string& choice) {
    return run_program(test::meniscus_program(), {"surface", path, "--altloc", choice, "--device", "cpu"});
  };
  for (const char* choice : {"best", "first", "A", "B"}) {
    EXPECT_NE(run(choice).err.find("1 in other alternate locations left out; 1 used"), std::string::npos) << choice;
  }
  EXPECT_NE(run("all").err.find("2 atoms read; none left out; 2 used"), std::string::npos);
  EXPECT_NE(run("Z").err.find("no atom has the alternate location Z"), std::string::npos);
  const ProgramResult wrong = run("AB");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_EQ(wrong.err,
            "meniscus: error: --altloc: 'AB' is not best, first, all or one letter; see meniscus surface --help\n");
}

TEST(Warnings, AreSummedUpListedOrLeftAway) {
  const TemporaryFolder folder;
  std::string text;
  for (int n = 0; n < 5; ++n)
    text += PdbLine{.number = n, .x = fmt::format("{:8.3f}", 3.0 * n), .occupancy = "******"}.text();
  const std::string path = folder.file("a.pdb", text);
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"surface", path, "--device", "cpu"});
    return run_program(test::meniscus_program(), more).err;
  };
  const std::string summary = run({});
  EXPECT_EQ(lines_of(summary), 2u) << summary;
  EXPECT_NE(summary.find("warning: " + path +
                         ": 5 atoms have no readable occupancy; treated as missing (first: line 1, '******')\n"),
            std::string::npos)
      << summary;
  const std::string full = run({"--warnings", "full"});
  EXPECT_EQ(lines_of(full), 7u) << full;
  EXPECT_NE(full.find("meniscus:   line 5, '******'\n"), std::string::npos) << full;
  EXPECT_EQ(lines_of(run({"--warnings", "none"})), 1u);
  EXPECT_EQ(lines_of(run({"--quiet", "--warnings", "full"})), 0u);
}

TEST(Formats, AreListedWithTheirMetadata) {
  const ProgramResult table = run_program(test::meniscus_program(), {"formats"});
  ASSERT_EQ(table.exit_code, 0);
  const ProgramResult json = run_program(test::meniscus_program(), {"formats", "--json"});
  const nlohmann::json formats = nlohmann::json::parse(json.out);
  std::map<std::string, int> kinds;
  for (const nlohmann::json& format : formats) {
    for (const char* key : {"name", "description", "reads", "reference"}) {
      EXPECT_FALSE(format.at(key).get<std::string>().empty()) << format;
    }
    EXPECT_FALSE(format.at("extensions").empty());
    EXPECT_NE(table.out.find(format.at("name").get<std::string>() + " "), std::string::npos);
    ++kinds[format.at("kind").get<std::string>()];
  }
  EXPECT_EQ(kinds, (std::map<std::string, int>{{"structure", 13}, {"trajectory", 10}}));
  EXPECT_TRUE(table.out.starts_with("PDB"));
}

}  // namespace
}  // namespace meniscus
