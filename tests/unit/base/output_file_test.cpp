// SPDX-License-Identifier: BSD-3-Clause
// Outputs appear whole or not at all, and never replace anything unasked.
#include "core/base/output_file.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

namespace fs = std::filesystem;
using test::read_bytes;
using test::TemporaryFolder;
using Names = std::vector<std::string>;

TEST(OutputFile, AppearsOnCommitOnly) {
  const TemporaryFolder folder;
  const fs::path target = folder.path() / "a.txt";
  {
    OutputFile file(target, Existing::refuse);
    file.write("half");
    EXPECT_FALSE(fs::exists(target));
    file.write(" whole");
    file.commit();
  }
  EXPECT_EQ(read_bytes(target), "half whole");
  EXPECT_EQ(folder.entries(), Names{"a.txt"});
}

TEST(OutputFile, LeavesNothingWhenAbandoned) {
  const TemporaryFolder folder;
  {
    OutputFile file(folder.path() / "a.txt", Existing::refuse);
    file.write("half");
    EXPECT_EQ(folder.entries().size(), 1u);
  }
  EXPECT_EQ(folder.entries(), Names{});
}

TEST(OutputFile, RefusesExistingUnlessForced) {
  const TemporaryFolder folder;
  const fs::path target = folder.file("a.txt", "old");
  EXPECT_THROW(OutputFile(target, Existing::refuse), OutputError);
  OutputFile file(target, Existing::replace);
  file.write("new");
  EXPECT_EQ(read_bytes(target), "old");
  file.commit();
  EXPECT_EQ(read_bytes(target), "new");
}

TEST(OutputFile, RefusesATargetThatAppearsMeanwhile) {
  const TemporaryFolder folder;
  OutputFile file(folder.path() / "a.txt", Existing::refuse);
  file.write("ours");
  folder.file("a.txt", "theirs");
  EXPECT_THROW(file.commit(), OutputError);
  EXPECT_EQ(read_bytes(folder.path() / "a.txt"), "theirs");
}

TEST(OutputFile, ReplacesALinkWithoutFollowingIt) {
  const TemporaryFolder folder;
  const fs::path precious = folder.file("precious", "keep me");
  fs::create_symlink(precious, folder.path() / "link");
  EXPECT_THROW(OutputFile(folder.path() / "link", Existing::refuse), OutputError);
  OutputFile file(folder.path() / "link", Existing::replace);
  file.write("new");
  file.commit();
  EXPECT_EQ(read_bytes(precious), "keep me");
  EXPECT_FALSE(fs::is_symlink(folder.path() / "link"));
}

TEST(OutputFile, ObeysTheUmask) {
  const TemporaryFolder folder;
  const mode_t old = ::umask(027);
  OutputFile file(folder.path() / "a", Existing::refuse);
  file.commit();
  ::umask(old);
  EXPECT_EQ(static_cast<unsigned>(fs::status(folder.path() / "a").permissions()), 0640u);
}

TEST(OutputFile, TemporaryNameKeepsTheExtensionForLibraries) {
  const TemporaryFolder folder;
  OutputFile file(folder.path() / "picture.png", Existing::refuse);
  EXPECT_EQ(file.temporary_path().extension(), ".png");
  folder.file(file.temporary_path().filename().string(), "written by name");
  file.commit();
  EXPECT_EQ(read_bytes(folder.path() / "picture.png"), "written by name");
}

TEST(OutputFile, RefusesUnsuitableTargets) {
  const TemporaryFolder folder;
  EXPECT_THROW(OutputFile(folder.path(), Existing::replace), OutputError);
  EXPECT_THROW(OutputFile(folder.path() / "missing" / "a", Existing::replace), OutputError);
  EXPECT_THROW(OutputFile("/dev/null", Existing::replace), OutputError);
  EXPECT_THROW(OutputFile("", Existing::replace), OutputError);
}

TEST(OutputFile, AFullDiskIsAnErrorAndLeavesNothing) {
  const TemporaryFolder folder;
  rlimit old{};
  ::getrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, old.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  {
    OutputFile file(folder.path() / "a", Existing::refuse);
    EXPECT_THROW(file.write(std::string(5000, 'x')), OutputError);
  }
  ::setrlimit(RLIMIT_FSIZE, &old);
  EXPECT_EQ(folder.entries(), Names{});
}

/// Work in a process of its own, which ends as one does that is stopped: its last word is stop(folder, names), which
/// looks whether the folder holds these names then.
template <typename Work>
void expect_stopped_well(const Work& work) {
  const TemporaryFolder folder;
  EXPECT_EXIT(work(folder), testing::ExitedWithCode(0), "");
}

void stop(const TemporaryFolder& folder, const Names& names) {
  remove_unfinished_outputs();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  ::_exit(folder.entries() == names ? 0 : 1);
}

TEST(OutputFile, StoppingRemovesUnfinishedFiles) {
  expect_stopped_well([](const TemporaryFolder& folder) {
    OutputFile file(folder.path() / "a", Existing::refuse);
    OutputFile done(folder.path() / "b", Existing::refuse);
    done.commit();
    stop(folder, {"b"});
  });
}

TEST(OutputFile, NothingIsBegunOnceStoppingHasBegun) {
  expect_stopped_well([](const TemporaryFolder& folder) {
    std::atomic<int> begun{0};
    const auto begin_files = [&] {
      for (;; ++begun) OutputFile file(folder.path() / "a", Existing::refuse);
    };
    for (int n = 0; n < 4; ++n) std::thread(begin_files).detach();
    while (begun < 100) std::this_thread::yield();
    stop(folder, {});
  });
}

TEST(OutputFile, AnInputIsKnownByAnyName) {
  const TemporaryFolder folder;
  const fs::path input = folder.file("in", "1"), hard = folder.path() / "hard", soft = folder.path() / "soft";
  fs::create_hard_link(input, hard);
  fs::create_symlink(input, soft);
  protect_input(soft);
  for (const fs::path& name : {input, hard, soft}) {
    EXPECT_THROW(OutputFile(name, Existing::replace), OutputError) << name;
  }
  EXPECT_NO_THROW(OutputFile(folder.path() / "free", Existing::replace));
}

TEST(OutputFolder, AllFilesOrNone) {
  const TemporaryFolder folder;
  const fs::path target = folder.path() / "deep" / "scene";
  {
    OutputFolder scene(target, Existing::refuse);
    scene.file("scene.inc").write("1");
    EXPECT_TRUE(fs::exists(target));
  }
  EXPECT_EQ(folder.entries(), Names{});
  OutputFolder scene(target, Existing::refuse);
  scene.file("scene.inc").write("1");
  scene.file("scene.pov").write("2");
  scene.commit();
  EXPECT_EQ(read_bytes(target / "scene.inc") + read_bytes(target / "scene.pov"), "12");
}

TEST(OutputFolder, StoppingRemovesItToo) {
  expect_stopped_well([](const TemporaryFolder& folder) {
    OutputFolder scene(folder.path() / "a" / "b", Existing::refuse);
    scene.file("scene.pov").write("2");
    stop(folder, {});
  });
}

TEST(OutputFolder, TakesNewFilesBackWhenALaterOneFails) {
  const TemporaryFolder folder;
  {
    OutputFolder scene(folder.path(), Existing::refuse);
    scene.file("first").write("1");
    scene.file("second").write("2");
    folder.file("second", "theirs");
    EXPECT_THROW(scene.commit(), OutputError);
  }
  EXPECT_EQ(folder.entries(), Names{"second"});
  EXPECT_EQ(read_bytes(folder.path() / "second"), "theirs");
}

TEST(OutputFolder, TakesPlainNamesOnly) {
  const TemporaryFolder folder;
  OutputFolder scene(folder.path(), Existing::refuse);
  EXPECT_THROW(scene.file("../a"), OutputError);
  EXPECT_THROW(scene.file(".."), OutputError);
  EXPECT_THROW(scene.file(""), OutputError);
  EXPECT_THROW(OutputFolder(folder.file("plain", ""), Existing::replace), OutputError);
  EXPECT_THROW(OutputFolder(folder.path() / "plain" / "below", Existing::replace), OutputError);
  EXPECT_THROW(OutputFolder(folder.path() / std::string(300, 'x'), Existing::replace), OutputError);
  EXPECT_THROW(OutputFolder("", Existing::replace), OutputError);
  EXPECT_THROW(OutputFile(folder.path() / std::string(300, 'x'), Existing::replace), OutputError);
}

}  // namespace
}  // namespace meniscus
