// SPDX-License-Identifier: BSD-3-Clause
// The program on a stopping GPU and on a second driver (zink on lavapipe): exit codes and files.
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/run_program.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

const std::string kLavapipe = vulkan_driver("lvp");

/// Runs the program with more variables in its environment.
test::ProgramResult run_with(std::vector<std::string> environment, const std::vector<std::string>& arguments) {
  environment.emplace_back(test::meniscus_program());
  environment.insert(environment.end(), arguments.begin(), arguments.end());
  return test::run_program("/usr/bin/env", environment, 200);
}

class StoppingGpu : public ::testing::Test {
 protected:
  /// Writes the first atoms of ubiquitin, alone and as two models.
  void SetUp() override {
    std::ifstream file(kUbiquitin);
    ASSERT_TRUE(file) << kUbiquitin;
    std::string model;
    int count = 0;
    for (std::string line; count < 60 && std::getline(file, line);)
      if (line.starts_with("ATOM")) model += line + "\n", ++count;
    molecule_ = folder_.file("molecule.pdb", model + "END\n");
    run_ = folder_.file("run.pdb", "MODEL        1\n" + model + "ENDMDL\nMODEL        2\n" + model + "ENDMDL\n");
  }

  test::ProgramResult with_fault(const std::string& fault, const std::vector<std::string>& arguments) const {
    return run_with({std::string("LD_PRELOAD=") + GL_FAULTS, "MENISCUS_TEST_GL_FAULT=" + fault}, arguments);
  }
  std::string path(const char* name) const { return (folder_.path() / name).string(); }

  void ends_with_code_4(const std::vector<std::string>& arguments, const std::string& output) const {
    for (const char* fault : {"drop_from 0", "drop_from 9", "drop_one 5", "reset 40"}) {
      const auto result = with_fault(fault, arguments);
      EXPECT_EQ(result.exit_code, 4) << arguments.front() << ", " << fault << ": " << result.err;
      EXPECT_NE(result.err.find("GPU"), std::string::npos) << result.err;
      EXPECT_EQ(result.out, "") << fault;
      EXPECT_FALSE(!output.empty() && std::filesystem::exists(output)) << fault;
    }
  }

  test::TemporaryFolder folder_;
  std::string molecule_, run_;
};

TEST_F(StoppingGpu, SurfaceIsRefused) { ends_with_code_4({"surface", molecule_, "--device", "software", "-q"}, ""); }

TEST_F(StoppingGpu, PicturesAreRefused) {
  const std::string picture = path("picture.png");
  for (const char* extent : {"visible", "complete"}) {
    ends_with_code_4({"render", molecule_, "--extent", extent, "--size", "64x48", "-q", "-o", picture}, picture);
  }
  ends_with_code_4({"render", molecule_, "--device", "software", "--color", "element", "--legend", "--size", "640x480",
                    "--ambient-occlusion", "0.8", "-q", "-o", picture},
                   picture);
}

TEST_F(StoppingGpu, PicturesOnTheCpuDoNotNotice) {
  const std::string picture = path("picture.png");
  const auto result = with_fault("drop_from 0", {"render", molecule_, "--device", "cpu", "--color", "element", "--size",
                                                 "64x48", "--ambient-occlusion", "0.8", "--verbose", "-o", picture});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("picture on cpu"), std::string::npos) << result.err;
  EXPECT_TRUE(std::filesystem::exists(picture));
  const std::vector<std::string> frames{"render", run_,    "--frames", "all", "--device",         "cpu",
                                        "--size", "64x48", "-q",       "-o",  path("frame_#.png")};
  EXPECT_EQ(with_fault("drop_from 0", frames).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(path("frame_1.png")));
}

TEST_F(StoppingGpu, WithoutMemoryIsAnotherError) {
  const std::string picture = path("picture.png");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"surface", molecule_, "--device", "software", "-q"},
        {"render", molecule_, "--extent", "visible", "--size", "64x48", "-q", "-o", picture}}) {
    const auto result = with_fault("out_of_memory 30", arguments);
    EXPECT_EQ(result.exit_code, 5) << result.err;
    EXPECT_FALSE(std::filesystem::exists(picture));
  }
}

TEST_F(StoppingGpu, FarmLeavesTheFrameUndone) {
  const std::string bundle = path("bundle");
  const auto made =
      test::run_program(test::meniscus_program(), {"farm", "bundle", bundle, "--chunk-frames", "2", "--", "render",
                                                   run_, "--frames", "all", "--size", "64x48", "--device", "software"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto worked = with_fault("drop_from 4", {"work", bundle});
  EXPECT_EQ(worked.exit_code, 4) << worked.err;
  EXPECT_FALSE(std::filesystem::exists(bundle + "/images/frame_00000.png"));
  EXPECT_EQ(test::run_program(test::meniscus_program(), {"work", bundle}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(bundle + "/images/frame_00000.png"));
}

std::vector<std::string> zink_environment(const test::TemporaryFolder& folder) {
  return {"LIBGL_ALWAYS_SOFTWARE=1", "MESA_LOADER_DRIVER_OVERRIDE=zink", "VK_ICD_FILENAMES=" + kLavapipe,
          "XDG_RUNTIME_DIR=" + folder.path().string()};
}

// One pipeline serves one molecule after another: here zink once started kernels with an earlier one's numbers.
TEST(SecondDriver, TakesMoleculesInTurn) {
  const test::TemporaryFolder folder;
  const auto result = test::run_program("/usr/bin/env", [&] {
    auto arguments = zink_environment(folder);
    arguments.insert(arguments.end(), {GPU_SURFACE_TEST, "--gtest_filter=*.MoleculesInTurn"});
    return arguments;
  }());
  EXPECT_EQ(result.exit_code, 0) << result.out;
  EXPECT_NE(result.out.find("[  PASSED  ] 1 test."), std::string::npos) << result.out;
}

TEST(SecondDriver, FindsTheSameSurface) {
  ASSERT_TRUE(std::filesystem::exists(kLavapipe)) << "mesa-vulkan-drivers is missing";
  const test::TemporaryFolder folder;
  const auto zink = zink_environment(folder);
  const auto surface = run_with(zink, {"surface", kUbiquitin, "--device", "software", "--verify", "-q"});
  EXPECT_EQ(surface.exit_code, 0) << surface.err;
  EXPECT_NE(surface.out.find("zink"), std::string::npos) << "another driver: " << surface.out;
  const auto draw = [&](const std::vector<std::string>& environment, const char* extent) {
    const std::string picture = (folder.path() / "picture.png").string();
    const auto result = run_with(environment, {"render", kUbiquitin, "--device", "software", "--extent", extent,
                                               "--size", "160x120", "--force", "-q", "--no-provenance", "-o", picture});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return test::read_bytes(picture);
  };
  EXPECT_EQ(draw(zink, "visible"), draw(zink, "complete"));
}

}  // namespace
}  // namespace meniscus
