// SPDX-License-Identifier: BSD-3-Clause
// The kept index is used while its file is unchanged, is built again otherwise, and never gets in the way.
#include <chrono>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/trajectory/formats/trajectory_formats.h"
#include "tests/support/run_program.h"
#include "tests/trajectory/samples.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

/// Writes the trajectory with an earlier time: indices of files that changed just now are not kept.
std::string write_old(const TemporaryFolder& folder, const std::string& bytes, int hours = 1) {
  const std::string path = folder.file("a.xtc", bytes);
  fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(hours));
  return path;
}

std::uint64_t frames_of(const std::string& path, const std::string& index_folder) {
  return open_trajectory(path, {index_folder})->frame_count();
}

TEST(FrameIndex, IsKeptAndUsed) {
  const TemporaryFolder folder;
  const std::string path = write_old(folder, test::xtc({})), keep = (folder.path() / "made" / "here").string();
  EXPECT_EQ(frames_of(path, keep), 3U);
  const std::string index = frame_index_path(keep, path);
  ASSERT_TRUE(fs::exists(index));
  const std::string kept = test::read_bytes(index);
  EXPECT_EQ(frames_of(path, keep), 3U);
  EXPECT_EQ(test::read_bytes(index), kept);
  // Damage that size and time do not show tells whether the index is used.
  const auto time = fs::last_write_time(path);
  std::string damaged = test::xtc({});
  damaged[test::xtc({.frames = 1}).size()] = 1;  // a walk would end here
  folder.file("a.xtc", damaged);
  fs::last_write_time(path, time);
  EXPECT_EQ(frames_of(path, keep), 3U);
  EXPECT_EQ(frames_of(path, ""), 1U);
  const auto trajectory = open_trajectory(path, {keep});
  Frame frame;
  trajectory->read(2, frame);
  EXPECT_NE(test::refusal([&] { trajectory->read(1, frame); }).find("frame 1 at byte"), std::string::npos);
}

TEST(FrameIndex, IsBuiltAnewWhenTheFileOrTheIndexChanged) {
  const TemporaryFolder folder;
  const std::string keep = folder.path().string();
  EXPECT_EQ(frames_of(write_old(folder, test::xtc({})), keep), 3U);
  EXPECT_EQ(frames_of(write_old(folder, test::xtc({.frames = 5})), keep), 5U);
  const std::string path = write_old(folder, test::xtc({.atoms = 9, .frames = 2}), 2);
  EXPECT_EQ(frames_of(path, keep), 2U);
  const std::string index = frame_index_path(keep, path);
  const std::string whole = test::read_bytes(index);
  for (std::size_t n = 0; n < whole.size(); n += 5) {
    std::string damaged = whole;
    damaged[n] = static_cast<char>(damaged[n] ^ 0x10);
    folder.file(fs::path(index).filename().string(), n % 2 == 0 ? damaged : whole.substr(0, n));
    EXPECT_EQ(frames_of(path, keep), 2U);
    EXPECT_EQ(test::read_bytes(index), whole);
  }
}

TEST(FrameIndex, SizeAndTimeBothCount) {
  const TemporaryFolder folder;
  const std::string keep = folder.path().string();
  const std::string path = write_old(folder, test::xtc({}));
  EXPECT_EQ(frames_of(path, keep), 3U);
  const auto time = fs::last_write_time(path);
  folder.file("a.xtc", test::xtc({.frames = 4}));
  fs::last_write_time(path, time);
  EXPECT_EQ(frames_of(path, keep), 4U);
  std::string damaged = test::xtc({.frames = 4});
  damaged[test::xtc({.frames = 1}).size()] = 1;
  EXPECT_EQ(frames_of(write_old(folder, damaged, 3), keep), 1U);
}

TEST(FrameIndex, IsNotKeptWhereItMayBecomeWrong) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.xtc", test::xtc({}));
  EXPECT_EQ(frames_of(path, folder.path().string()), 3U);
  EXPECT_FALSE(fs::exists(frame_index_path(folder.path().string(), path)));
}

TEST(FrameIndex, FoldersThatCannotBeUsedDoNoHarm) {
  const TemporaryFolder folder;
  const std::string path = write_old(folder, test::xtc({}));
  EXPECT_EQ(frames_of(path, "/proc/no/such/folder"), 3U);
  EXPECT_EQ(frames_of(path, path), 3U);
}

TEST(FrameIndex, AFileThatIsCutKeepsSayingSo) {
  const TemporaryFolder folder;
  const std::string bytes = test::xtc({}), path = write_old(folder, bytes.substr(0, bytes.size() - 1));
  for (int time = 0; time < 2; ++time) {
    const auto trajectory = open_trajectory(path, {folder.path().string()});
    EXPECT_EQ(trajectory->cut_short(), "the file ends within frame 2; its 2 whole frames are used");
  }
}

}  // namespace
}  // namespace meniscus
