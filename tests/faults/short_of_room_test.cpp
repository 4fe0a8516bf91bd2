// SPDX-License-Identifier: BSD-3-Clause
// Full disks, no memory and a closed output give one line, the documented code, and no half file.
#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/run_program.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

using test::ProgramResult;
using test::read_bytes;
using test::TemporaryFolder;
using Names = std::vector<std::string>;

constexpr const char* kFourBalls = "0 0 0 1.7\n2.6 0 0 1.6\n1.2 2.2 0.1 1.8\n1.1 0.8 2.1 1.5\n";
constexpr int kBytesOfABlock = 512;  // block size of the shell's ulimit -f

/// Runs the program in a shell: `before` may set limits, `after` redirects.
ProgramResult in_shell(const std::string& before, const std::string& arguments, const std::string& after = "") {
  return test::run_program("/bin/sh", {"-c", before + "\n" + test::meniscus_program() + " " + arguments + " " + after});
}

bool is_one_line(const std::string& err) {
  return err.starts_with("meniscus: error: ") && std::ranges::count(err, '\n') == 1;
}

class NoRoom : public ::testing::Test {
 protected:
  void expect_refused(int blocks, const std::string& arguments, const std::string& reason) {
    const ProgramResult result = in_shell(fmt::format("ulimit -f {}", blocks), arguments);
    EXPECT_EQ(result.exit_code, 6) << arguments << result.err;
    EXPECT_NE(result.err.find(reason), std::string::npos) << result.err;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_EQ(folder_.entries(), Names{"four.xyzr"}) << arguments;
  }

  TemporaryFolder folder_;
  std::string in_ = folder_.file("four.xyzr", kFourBalls), out_ = folder_.path().string() + "/";
};

TEST_F(NoRoom, ForAPicture) {
  for (const char* const extension : {"png", "tif", "jpg", "exr"})
    expect_refused(1, fmt::format("render {} -q --size 64x48 -o {}a.{}", in_, out_, extension), "File too large");
}

TEST_F(NoRoom, ForASceneOrTable) {
  expect_refused(1, fmt::format("export ply {} -q --device cpu -o {}a.ply", in_, out_), "File too large");
  expect_refused(1, fmt::format("export povray {} -q --device cpu -o {}scene", in_, out_), "File too large");
  expect_refused(1, fmt::format("export blender {} -q --device cpu -o {}a.mns", in_, out_), "File too large");
  expect_refused(1, fmt::format("surface {} -q --device cpu --csv {}a.csv", kUbiquitin, out_), "File too large");
}

// A film lacks its first pictures, or its last bytes only.
TEST_F(NoRoom, ForAFilm) {
  for (const char* extension : {"mp4", "mkv", "mov"}) {
    const std::string film = out_ + "a." + extension;
    const std::string arguments = fmt::format("render {} -q --size 64x48 --frames all -o {}", in_, film);
    ASSERT_EQ(in_shell("", arguments).exit_code, 0);
    const int blocks = static_cast<int>(std::filesystem::file_size(film)) / kBytesOfABlock;
    std::filesystem::remove(film);
    for (const int room : {1, blocks}) expect_refused(room, arguments, "ffmpeg failed: ");
  }
}

// Memory grows until it suffices; where even loading fails, which is the system's, the program ends with 127.
TEST(NoMemory, IsOneLineAndExitFive) {
  bool was_refused = false, was_enough = false;
  for (int megabytes = 24; megabytes <= 3400 && !was_enough; megabytes += megabytes / 8) {
    const ProgramResult result =
        in_shell(fmt::format("ulimit -v {}", megabytes * 1024), std::string("surface -q --device cpu ") + kUbiquitin);
    if (result.exit_code == 127) continue;
    was_enough = result.exit_code == 0;
    if (was_enough) continue;
    was_refused = true;
    EXPECT_EQ(result.exit_code, 5) << megabytes << result.err;
    EXPECT_NE(result.err.find("meniscus: error: "), std::string::npos) << megabytes << result.err;
    EXPECT_EQ(result.out, "") << megabytes;
  }
  EXPECT_TRUE(was_enough);
  EXPECT_TRUE(was_refused);
}

TEST(StandardOutput, ThatIsFullOrClosedIsAnError) {
  for (const std::string& arguments :
       {std::string("--version"), std::string("--help"), std::string("surface --help"), std::string("help"),
        std::string("formats"), std::string("colors"), std::string("info -q ") + kUbiquitin,
        std::string("surface -q --device cpu ") + kUbiquitin,
        std::string("surface -q --json --device cpu ") + kUbiquitin,
        std::string("surface -q --csv - --device cpu ") + kUbiquitin}) {
    for (const auto& [after, why] :
         {std::pair(">/dev/full", "No space left on device"), {">&-", "Bad file descriptor"}}) {
      const ProgramResult result = in_shell("", arguments, after);
      EXPECT_EQ(result.exit_code, 6) << arguments << after;
      // The reason is known if writing fails at the end, and not in the middle.
      const std::string sentence = "meniscus: error: standard output: cannot be written";
      EXPECT_TRUE(result.err == sentence + "\n" || result.err == sentence + ": " + why + "\n")
          << arguments << after << result.err;
    }
  }
}

// Unread notes are not a failure, and above all they are not written into the file that is open next.
TEST(StandardError, ThatIsFullOrClosedIsNone) {
  const TemporaryFolder folder;
  const std::string in = folder.file("four.xyzr", kFourBalls);
  const std::string out = folder.path() / "a.ply";
  const std::string arguments = fmt::format("export ply {} --force --device cpu -o {}", in, out);
  ASSERT_EQ(in_shell("", arguments).exit_code, 0);
  const std::string sound = read_bytes(out);
  for (const char* after : {"2>/dev/full", "2>&-", "<&- >/dev/null 2>&-"}) {
    EXPECT_EQ(in_shell("", arguments, after).exit_code, 0) << after;
    EXPECT_EQ(read_bytes(out), sound) << after;
  }
}

TEST(StandardInput, ThatIsClosedCannotBeRead) {
  const ProgramResult result = in_shell("", "surface -q -", "<&-");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
}

}  // namespace
}  // namespace meniscus
