// SPDX-License-Identifier: BSD-3-Clause
// The program's promises: help, JSON, exit codes for options, and the use of stdout and stderr.
#include <algorithm>
#include <cmath>
#include <regex>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/version.h"
#include "tests/support/run_program.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

using nlohmann::json;
using test::ProgramResult;
using test::TemporaryFolder;

ProgramResult meniscus_says(const std::vector<std::string>& arguments) {
  return test::run_program(test::meniscus_program(), arguments);
}

json surface_json(const std::vector<std::string>& arguments) {
  std::vector<std::string> all{"surface", "--json"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const ProgramResult result = meniscus_says(all);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return json::parse(result.out, nullptr, false);
}

TEST(Help, ExamplesComeBeforeOptions) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--help"},
                                                {"surface", "--help"},
                                                {"info", "-h"},
                                                {"bench", "--help"},
                                                {"export", "--help"}}) {
    const ProgramResult result = meniscus_says(words);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
    const std::size_t examples = result.out.find("Examples:");
    EXPECT_LT(examples, result.out.find("Usage:")) << result.out;
    EXPECT_LT(result.out.find("Usage:"), result.out.find("Options:")) << result.out;
    EXPECT_TRUE(result.out.ends_with("\n"));
  }
  EXPECT_NE(meniscus_says({"--help"}).out.find("7 surface not closed"), std::string::npos);
}

TEST(Help, VersionIsOneLine) {
  const ProgramResult result = meniscus_says({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  // The text has the version, and the commit or, without a repository, a checksum of the sources.
  const std::regex expected("meniscus " MENISCUS_VERSION R"(\+[gs][0-9a-f]{12}(\.dirty\.[0-9a-f]{12})?\n)");
  EXPECT_TRUE(std::regex_match(result.out, expected)) << result.out;
}

// OpenImageIO and its libraries take a quarter of a second, so they are loaded with the first picture (core/image).
TEST(Start, OpenImageIOIsNotLoadedForNothing) {
  const ProgramResult linked = test::run_program("/usr/bin/ldd", {test::meniscus_program()});
  ASSERT_EQ(linked.exit_code, 0) << linked.err;
  EXPECT_NE(linked.out.find("libstdc++"), std::string::npos) << linked.out;
  EXPECT_EQ(linked.out.find("OpenImageIO"), std::string::npos) << linked.out;
}

TEST(Usage, WrongOptionsExitWithTwoAndSayWhy) {
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{}, "subcommand"},
      {{"surfac", kUbiquitin}, "surfac"},
      {{"surface"}, "FILE"},
      {{"surface", kUbiquitin, "--nonsense"}, "--nonsense"},
      {{"surface", kUbiquitin, "--probe"}, "--probe"},
      {{"surface", kUbiquitin, "--probe", "-1"}, "negative"},
      {{"surface", kUbiquitin, "--probe", "nan"}, "not a finite number"},
      {{"surface", kUbiquitin, "--probe", "inf"}, "not a finite number"},
      {{"surface", kUbiquitin, "--probe", "1.4 nm"}, "not a finite number"},
      {{"surface", kUbiquitin, "--probe", "1e400"}, "not a finite number"},
      {{"surface", kUbiquitin, "--probe", "1e-9"}, "van der Waals"},
      {{"surface", kUbiquitin, "--probe", "1e4"}, "at most 100 Å"},
      {{"surface", kUbiquitin, "--device", "gpux"}, "not one of auto"},
      {{"surface", kUbiquitin, "--device", "gpu:-1"}, "not one of auto"},
      {{"surface", kUbiquitin, "--threads", "0"}, "--threads"},
      {{"surface", kUbiquitin, "--threads", "two"}, "--threads"},
      {{"surface", kUbiquitin, "--unknown-element", "maybe"}, "--unknown-element"},
      {{"bench", kUbiquitin, "--runs", "0"}, "--runs"},
      {{"bench"}, "FILES"},
      {{"export"}, "subcommand"},
  };
  for (const auto& [arguments, reason] : cases) {
    const ProgramResult result = meniscus_says(arguments);
    EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(arguments) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(result.err.starts_with("meniscus: error: ")) << result.err;
    EXPECT_NE(result.err.find(reason), std::string::npos) << testing::PrintToString(arguments) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

TEST(Surface, JsonHasTheWholeSchema) {
  const json result = surface_json({kToxin, "--device", "cpu"});
  ASSERT_TRUE(result.is_object());
  std::vector<std::string> keys;
  for (const auto& [key, value] : result.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"area", "atoms", "cavities", "cavity_area", "cavity_volume", "certificate",
                                            "components", "counts", "device", "groups", "probe_radius", "radii_set",
                                            "sas_area", "schema_version", "ses_area", "stages", "surface", "volume"}));
  EXPECT_EQ(result["schema_version"], 2);
  EXPECT_EQ(result["atoms"], json::parse(R"({"read":5684,"excluded":{"water":215},"used":5469})"));
  EXPECT_EQ(result["probe_radius"], 1.4);
  EXPECT_EQ(result["radii_set"], "bondi");
  EXPECT_EQ(result["certificate"]["closed"], true);
  EXPECT_TRUE(result["device"].get<std::string>().starts_with("cpu"));
  for (const json& stage : result["stages"]) {
    EXPECT_TRUE(stage.at("name").is_string());
    EXPECT_GE(stage.at("ms").get<double>(), 0.0);
  }
  EXPECT_FALSE(result["stages"].empty());
}

TEST(Surface, NumbersOfTheToxinAreTheIndependentOnes) {
  const json result = surface_json({kToxin, "--device", "cpu"});
  const json& counts = result["counts"];
  EXPECT_EQ(counts["fixed_probes"], 6460);
  EXPECT_EQ(counts["arcs"], 9690);
  EXPECT_EQ(counts["free_edges"], 3);
  EXPECT_EQ(counts["convex"], 3019);
  EXPECT_EQ(counts["spindle"], 634);
  EXPECT_NEAR(result["area"].get<double>(), 28275.6, 0.5);
  EXPECT_NEAR(result["volume"].get<double>(), 85926.0, 3.0);
  double area = 0.0, volume = 0.0;
  for (const json& component : result["components"]) {
    area += component["area"].get<double>();
    volume += component["signed_volume"].get<double>();
    EXPECT_EQ(component["euler"].get<int>() % 2, 0);
    EXPECT_EQ(component["kind"] == "cavity", component["signed_volume"].get<double>() < 0.0);
  }
  EXPECT_NEAR(area, result["area"].get<double>(), 1e-6);
  EXPECT_NEAR(volume, result["volume"].get<double>(), 1e-6);
}

// Five spheres through one point have no surface unless radii grow, and a user of its area must know that.
TEST(Surface, SaysByHowMuchRadiiGrew) {
  const std::vector<std::string> tied{test::test_file("corpus/one-point-4239.xyzr"), "--probe", "0.5"};
  for (const std::string device : {"cpu", "software"}) {
    const json certificate = surface_json({tied[0], tied[1], tied[2], "--device", device})["certificate"];
    EXPECT_EQ(certificate["closed"], true);
    EXPECT_GT(certificate.value("radii_grown_by", 0.0), 0.0);
    EXPECT_LT(certificate.value("radii_grown_by", 1.0), 1e-5);
    EXPECT_GE(certificate.value("exact_for_radii_within", 0.0), certificate.value("radii_grown_by", 1.0));
    const ProgramResult result = meniscus_says({"surface", tied[0], tied[1], tied[2], "--device", device});
    EXPECT_NE(result.out.find("exact for radii that differ from these by up to"), std::string::npos) << result.out;
    EXPECT_NE(result.err.find("radii were increased by up to"), std::string::npos) << result.err;
  }
  const json certificate = surface_json({kUbiquitin, "--device", "cpu"})["certificate"];
  EXPECT_FALSE(certificate.contains("radii_grown_by"));
  EXPECT_EQ(certificate.value("exact_for_radii_within", 1.0), 0.0);
  EXPECT_EQ(meniscus_says({"surface", kUbiquitin, "--device", "cpu"}).out.find("exact for radii"), std::string::npos);
}

// BALL 1.5 states these areas of two balls of radius 1 and a probe of 1.5, and so does the closed form.
TEST(Surface, TwoSpheresOfTheLiterature) {
  const TemporaryFolder folder;
  EXPECT_NEAR(surface_json({folder.file("far.xyzr", "0 0 0 1\n10 0 0 1\n"), "--probe", "1.5"})["area"].get<double>(),
              25.13274, 1e-5);
  EXPECT_NEAR(surface_json({folder.file("near.xyzr", "0 0 0 1\n1 0 0 1\n"), "--probe", "1.5"})["area"].get<double>(),
              18.722, 1e-3);
}

TEST(Surface, SmallAndDegenerateMoleculesAreClosed) {
  const TemporaryFolder folder;
  const std::pair<const char*, double> cases[] = {
      {"0 0 0 1.7\n", 36.317},
      {"0 0 0 1.7\n3 0 0 1.7\n", 66.078},
      {"0 0 0 1.7\n3 0 0 1.7\n6 0 0 1.7\n", 95.839},
      {"0 0 0 1.7\n3 0 0 1.7\n0 3 0 1.7\n3 3 0 1.7\n", 115.727},
      {"0 0 0 1.7\n0 0 0 1.7\n", 36.317},
      {"0 0 0 3.0\n0.5 0 0 1.0\n", 113.097},
  };
  for (const auto& [balls, area] : cases) {
    const json result = surface_json({folder.file("a.xyzr", balls)});
    EXPECT_EQ(result["certificate"]["closed"], true) << balls;
    EXPECT_NEAR(result["area"].get<double>(), area, 6e-4) << balls;
  }
}

TEST(Surface, ProbeZeroIsTheVanDerWaalsSurface) {
  const TemporaryFolder folder;
  const double r = 1.7, d = 3.0;
  const json result = surface_json({folder.file("a.xyzr", "0 0 0 1.7\n3 0 0 1.7\n"), "--probe", "0"});
  EXPECT_NEAR(result["area"].get<double>(), 4.0 * M_PI * r * (r + d / 2.0), 1e-9);
}

TEST(Surface, ThreadsDoNotChangeTheNumbers) {
  json one = surface_json({kUbiquitin, "--device", "cpu", "--threads", "1"});
  json two = surface_json({kUbiquitin, "--device", "cpu", "--threads", "2"});
  for (json* result : {&one, &two}) {
    result->erase("stages");
    result->erase("device");
  }
  EXPECT_EQ(one, two);
}

TEST(Surface, NotesGoToStderrAndQuietSilencesThem) {
  const ProgramResult loud = meniscus_says({"surface", kUbiquitin});
  EXPECT_NE(loud.err.find("660 atoms read; 58 water atoms left out; 602 used"), std::string::npos);
  EXPECT_NE(loud.out.find("closed        yes"), std::string::npos);
  EXPECT_EQ(meniscus_says({"surface", kUbiquitin, "--quiet"}).err, "");
}

TEST(Info, TellsChainsClassesAndRadii) {
  const ProgramResult result = meniscus_says({"info", kToxin});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"5,684 in the file; a surface takes 5,469", "water                 215        215",
                           "C                   3,405      1.70  Bondi 1964", "A                   1,479        186"}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
  }
}

TEST(Info, ReadsWhatHasNothingForASurface) {
  EXPECT_EQ(meniscus_says({"info", "/usr/share/pymol/data/chempy/water.pdb"}).exit_code, 0);
  EXPECT_EQ(meniscus_says({"surface", "/usr/share/pymol/data/chempy/water.pdb"}).exit_code, 3);
  EXPECT_EQ(meniscus_says({"surface", "/usr/share/pymol/data/chempy/water.pdb", "--keep-water", "-q"}).exit_code, 0);
}

TEST(Usage, AVanDerWaalsSurfaceHasNoProbe) {
  const ProgramResult result = meniscus_says({"surface", kUbiquitin, "--probe", "1", "--surface", "vdw", "-q"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("has no probe"), std::string::npos) << result.err;
}

TEST(Bench, PrintsARowForEachFile) {
  const ProgramResult result =
      meniscus_says({"bench", kUbiquitin, kUbiquitin, "--runs", "1", "-q", "--device", "cpu", "--baseline"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 3) << result.out;
  EXPECT_NE(result.out.find("total ms"), std::string::npos);
  EXPECT_NE(result.out.find("rolled, outer"), std::string::npos);
  EXPECT_EQ(meniscus_says({"bench", kUbiquitin, "--runs", "1", "-q", "--device", "cpu", "--numbers"}).exit_code, 0);
}

TEST(Bench, PaperPrintsBothExtentsBesideThePapersFigures) {
  const TemporaryFolder folder;
  const std::string balls = folder.file("1crn.xyzr", "0 0 0 1.7\n3 0 0 1.7\n");
  const ProgramResult result = meniscus_says({"bench", "--paper", balls, "--runs", "1", "-q", "--size", "64x48"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("1crn.xyzr         2 complete"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("1crn.xyzr         2 visible"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("     31 "), std::string::npos) << result.out;
  EXPECT_EQ(meniscus_says({"bench", "--paper", balls, "--baseline"}).exit_code, 2);
  EXPECT_EQ(meniscus_says({"bench", "--paper", balls, "--numbers"}).exit_code, 2);
  EXPECT_EQ(meniscus_says({"bench", "--paper", balls, "--surface", "sas"}).exit_code, 2);
}

TEST(Output, ExistingFilesStayUnlessForced) {
  const TemporaryFolder folder;
  const std::string balls = folder.file("a.xyzr", "0 0 0 1.7\n3 0 0 1.7\n");
  const std::string scene = folder.path() / "scene";
  const std::vector<std::string> arguments{"export", "povray", balls, "-o", scene, "--device", "cpu", "--quiet"};
  EXPECT_EQ(meniscus_says(arguments).exit_code, 0);
  const ProgramResult again = meniscus_says(arguments);
  EXPECT_EQ(again.exit_code, 6);
  EXPECT_NE(again.err.find("--force"), std::string::npos) << again.err;
  std::vector<std::string> forced = arguments;
  forced.push_back("--force");
  EXPECT_EQ(meniscus_says(forced).exit_code, 0);
}

TEST(Output, BadInputLeavesNothingBehind) {
  const TemporaryFolder folder;
  const std::string bad = folder.file("a.xyzr", "0 0 0 nan\n");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"export", "povray", bad, "-o", folder.path() / "scene"},
        {"render", bad, "-o", folder.path() / "a.png"}}) {
    EXPECT_EQ(meniscus_says(command).exit_code, 3);
    EXPECT_EQ(folder.entries().size(), 1u);
  }
}

TEST(Device, AMissingGpuIsExitFour) {
  const ProgramResult result = meniscus_says({"surface", kUbiquitin, "--device", "gpu:99"});
  EXPECT_EQ(result.exit_code, 4) << result.err;
}

// A machine with a GPU computes; one without a GPU must not use anything else.
TEST(Device, ARequiredGpuIsAGpuOrExitFour) {
  for (const char* device : {"cpu", "software"}) {
    const ProgramResult result = meniscus_says({"surface", kUbiquitin, "--require-gpu", "--device", device});
    EXPECT_EQ(result.exit_code, 4) << result.err;
    EXPECT_NE(result.err.find(std::string("--require-gpu and --device ") + device), std::string::npos);
  }
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"surface"}, {"export", "povray", "-o", "/nonexistent/scene"}, {"bench"}}) {
    std::vector<std::string> required = command, gpu = command;
    required.insert(required.end(), {kUbiquitin, "-q", "--require-gpu"});
    gpu.insert(gpu.end(), {kUbiquitin, "-q", "--device", "gpu"});
    EXPECT_EQ(meniscus_says(required).exit_code, meniscus_says(gpu).exit_code) << command[0];
  }
}

TEST(Signals, TerminateEndsTheProgramAsUsual) {
  const std::string command = test::meniscus_program() + " bench -q --runs 1000000 " + kUbiquitin +
                              " & pid=$!; sleep 0.3; kill -TERM $pid; wait $pid";
  EXPECT_EQ(test::run_program("/bin/sh", {"-c", command}).exit_code, 128 + 15);
}

TEST(Output, AFullStandardOutputIsAnError) {
  const std::string command = test::meniscus_program() + " surface -q " + kUbiquitin + " > /dev/full";
  const ProgramResult result = test::run_program("/bin/sh", {"-c", command});
  EXPECT_EQ(result.exit_code, 6);
  EXPECT_NE(result.err.find("standard output: cannot be written"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace meniscus
