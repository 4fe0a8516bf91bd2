// SPDX-License-Identifier: BSD-3-Clause
// Other processes write the same output, kill the program, forbid the folder, or change the input while it is read.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/text_file.h"
#include "tests/support/run_program.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

namespace fs = std::filesystem;
using test::ProgramResult;
using test::read_bytes;
using test::run_program;
using test::RunningProgram;
using test::TemporaryFolder;
using Names = std::vector<std::string>;

std::vector<std::string> ply_command(const fs::path& output) {
  return {"export", "ply", kUbiquitin, "-q", "--device", "cpu", "-o", output.string()};
}

TEST(TwoWriters, OneHasTheNameAndTheOtherSaysSo) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program(test::meniscus_program(), ply_command(folder.path() / "sound.ply")).exit_code, 0);
  const std::string sound = read_bytes(folder.path() / "sound.ply");
  for (int round = 0; round < 4; ++round) {
    const fs::path output = folder.path() / fmt::format("{}.ply", round);
    RunningProgram one(test::meniscus_program(), ply_command(output)),
        other(test::meniscus_program(), ply_command(output));
    const int codes = one.finish().exit_code + other.finish().exit_code;
    EXPECT_EQ(codes, 0 + 6);
    EXPECT_EQ(read_bytes(output), sound);
  }
  EXPECT_EQ(folder.entries(), (Names{"0.ply", "1.ply", "2.ply", "3.ply", "sound.ply"}));
}

TEST(TwoWriters, BothMayReplaceAndTheFileIsWhole) {
  const TemporaryFolder folder;
  std::vector<std::string> command = ply_command(folder.path() / "a.ply");
  command.emplace_back("--force");
  ASSERT_EQ(run_program(test::meniscus_program(), command).exit_code, 0);
  const std::string sound = read_bytes(folder.path() / "a.ply");
  RunningProgram one(test::meniscus_program(), command), other(test::meniscus_program(), command);
  EXPECT_EQ(one.finish().exit_code + other.finish().exit_code, 0);
  EXPECT_EQ(read_bytes(folder.path() / "a.ply"), sound);
  EXPECT_EQ(folder.entries(), Names{"a.ply"});
}

// No warning is needed: unfinished files are hidden, and named files are whole. The molecule makes a mesh of 1.8 MB.
TEST(Killed, AtAnyMomentItLeavesNoHalfFile) {
  const TemporaryFolder folder;
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(run_program(test::meniscus_program(), ply_command(folder.path() / "sound.ply")).exit_code, 0);
  const auto whole = std::chrono::steady_clock::now() - begin;
  const std::string sound = read_bytes(folder.path() / "sound.ply");
  constexpr int kMoments = 12;
  for (int moment = 0; moment < kMoments; ++moment) {
    const fs::path output = folder.path() / fmt::format("{}.ply", moment);
    {
      const RunningProgram running(test::meniscus_program(), ply_command(output));
      std::this_thread::sleep_for(whole * (moment + 1) / kMoments);
    }  // The destructor kills the program.
    if (fs::exists(output)) {
      EXPECT_EQ(read_bytes(output), sound);
    }
  }
  for (const std::string& name : folder.entries())
    EXPECT_TRUE(name.ends_with(".ply") && (name[0] == '.') == (name.find(".part.") != std::string::npos)) << name;
}

TEST(ForbiddenFolder, IsAnErrorBeforeTheWorkBegins) {
  std::vector<fs::path> folders{"/sys", "/proc"};  // Even root may not write there.
  const TemporaryFolder locked;
  if (::geteuid() != 0) {
    fs::permissions(locked.path(), fs::perms::owner_read | fs::perms::owner_exec);
    folders.push_back(locked.path());
  }
  for (const fs::path& folder : folders) {
    for (const std::vector<std::string>& command :
         {ply_command(folder / "a.ply"),
          {"export", "povray", kUbiquitin, "-q", "-o", folder / "scene"},
          {"render", kUbiquitin, "-q", "-o", folder / "a.png"},
          {"render", kUbiquitin, "-q", "--frames", "all", "-o", folder / "a.mp4"},
          {"surface", kUbiquitin, "-q", "--device", "cpu", "--csv", folder / "a.csv"}}) {
      const ProgramResult result = run_program(test::meniscus_program(), command);
      EXPECT_EQ(result.exit_code, 6) << command[0] << " " << command[1] << folder << result.err;
      EXPECT_EQ(result.err.find("meniscus: error: "), 0u) << result.err;
    }
  }
  fs::permissions(locked.path(), fs::perms::owner_all);
}

/// Returns frames of two carbon atoms that part slowly.
std::string parting(int frames) {
  std::string text;
  for (int frame = 0; frame < frames; ++frame) text += fmt::format("2\n\nC 0 0 0\nC 0 0 {:.4f}\n", 2 + 1e-4 * frame);
  return text;
}

/// Runs over the frames of a file that `change` changes as soon as the first frame is done.
ProgramResult run_while(const std::string& file, const std::function<void()>& change) {
  RunningProgram running(test::meniscus_program(),
                         {"surface", file, "--frames", "all", "--json", "-q", "--device", "cpu", "--threads", "1"});
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (running.out().empty() && std::chrono::steady_clock::now() < limit)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  change();
  return running.finish();
}

class ChangedTrajectory : public ::testing::Test {
 protected:
  static constexpr int kFrames = 3000;
  TemporaryFolder folder_;
  std::string file_ = folder_.file("parting.xyz", parting(kFrames));
};

TEST_F(ChangedTrajectory, ThatGrowsIsReadAsItWas) {
  const ProgramResult result = run_while(file_, [&] { std::ofstream(file_, std::ios::app) << parting(5); });
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(std::ranges::count(result.out, '\n'), kFrames);
}

TEST_F(ChangedTrajectory, ThatIsReplacedIsReadAsItWas) {
  const std::string other = folder_.file("other.xyz", parting(5));
  const ProgramResult result = run_while(file_, [&] { fs::rename(other, file_); });
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(std::ranges::count(result.out, '\n'), kFrames);
}

TEST_F(ChangedTrajectory, ThatShrinksOrIsWrittenAnewIsAnError) {
  const ProgramResult shrunk = run_while(file_, [&] { fs::resize_file(file_, 1000); });
  EXPECT_EQ(shrunk.exit_code, 3) << shrunk.err;
  EXPECT_NE(shrunk.err.find("while it was read"), std::string::npos) << shrunk.err;
  folder_.file("parting.xyz", parting(kFrames));
  const ProgramResult anew = run_while(file_, [&] { std::fstream(file_).write("2\n\nC 0 0 0\nC 0 0 9", 18); });
  EXPECT_EQ(anew.exit_code, 3) << anew.err;
  EXPECT_NE(anew.err.find("was changed while it was read"), std::string::npos) << anew.err;
}

// Another process writes the file again and again. (A writer that pauses in the middle for as long as we read is not
// noticed: the file then held that.)
TEST(ChangedMolecule, ThatIsWrittenMeanwhileIsRefused) {
  const TemporaryFolder folder;
  const std::string lines(std::size_t{24} << 20, '\n');
  const std::string text = "a" + lines;
  const std::string path = folder.file("molecule", text);
  std::atomic<bool> enough{false};
  std::thread writer([&] {
    while (!enough) std::fstream(path) << text;
  });
  int refused = 0;
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (refused < 3 && std::chrono::steady_clock::now() < limit) {
    try {
      EXPECT_EQ(read_text_file(path).text.size(), text.size());
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("was changed while it was read"), std::string::npos) << error.what();
      ++refused;
    }
  }
  enough = true;
  writer.join();
  EXPECT_EQ(refused, 3);
}

TEST(ChangedMolecule, ThatIsReplacedIsReadWhole) {
  const TemporaryFolder folder;
  const std::string path = folder.file("molecule", "one\n");
  std::atomic<bool> enough{false};
  std::thread writer([&] {
    for (int n = 0; !enough; ++n) fs::rename(folder.file("new", n % 2 ? "one\n" : "another one\n"), path);
  });
  for (int n = 0; n < 2000; ++n) {
    const std::string text = read_text_file(path).text;
    ASSERT_TRUE(text == "one\n" || text == "another one\n") << text;
  }
  enough = true;
  writer.join();
}

}  // namespace
}  // namespace meniscus
