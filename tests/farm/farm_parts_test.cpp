// SPDX-License-Identifier: BSD-3-Clause
// Tests small parts of a farm, each alone: checksums, chunks, templates, children, pictures without dates.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "app/farm/bundle.h"
#include "app/farm/bundle_folder.h"
#include "app/farm/make_bundle.h"
#include "app/farm/worker.h"
#include "app/process/child_process.h"
#include "app/process/program_main.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/image/png_file.h"
#include "tests/support/run_program.h"

namespace meniscus::farm {
namespace {

using test::TemporaryFolder;

Bundle bundle_of(std::uint64_t frames) {
  Bundle bundle;
  bundle.program_version = "1";
  bundle.command = {"render", "inputs/a.pdb"};
  for (std::uint64_t n = 0; n < frames; ++n) bundle.frames.push_back(3 * n);
  bundle.width = bundle.height = 10;
  return bundle;
}

// The examples come from FIPS 180-4; reading the second file takes several steps.
TEST(Checksum, IsSha256) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  const TemporaryFolder folder;
  const std::string more(3'000'000, 'b');
  EXPECT_EQ(sha256_of_file(folder.file("a", std::string(1'000'000, 'a'))),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_EQ(sha256_of_file(folder.file("b", more)), sha256(more));
  EXPECT_THROW(sha256_of_file(folder.path() / "missing"), InputError);
  EXPECT_THROW(sha256_of_file(folder.path()), InputError);
}

TEST(Chunks, AreTheRunCutIntoNearlyEqualParts) {
  for (const std::uint64_t frames : {1u, 7u, 98u}) {
    const Bundle bundle = bundle_of(frames);
    for (const std::uint64_t n : {1u, 2u, 5u, 98u, 200u}) {
      std::vector<std::uint64_t> all;
      std::size_t smallest = frames, largest = 0;
      for (std::uint64_t k = 1; k <= n; ++k) {
        const std::vector<std::uint64_t> chunk = chunk_of(bundle, k, n);
        all.insert(all.end(), chunk.begin(), chunk.end());
        smallest = std::min(smallest, chunk.size());
        largest = std::max(largest, chunk.size());
      }
      EXPECT_EQ(all, bundle.frames);
      EXPECT_LE(largest - smallest, 1u);
    }
  }
}

TEST(Chunks, AreAsLongAsWanted) {
  const struct {
    std::uint64_t frames;
    std::optional<std::uint64_t> wanted_frames;
    double seconds;
    std::uint64_t tasks;
  } cases[]{{100, {}, 30, 10}, {100, {}, 1000, 100}, {100, {}, 0.001, 1},
            {1, {}, 1e9, 1},   {3000, 1, 0, 3000},   {15, 7, 0, 3}};
  for (const auto& [frames, wanted_frames, seconds, tasks] : cases) {
    Chunking chunking;  // tasks of five minutes
    chunking.wanted_frames = wanted_frames;
    chunking.seconds_per_frame = seconds;
    EXPECT_EQ(chunking.wanted_count(frames), tasks);
  }
}

TEST(Tasks, AreGivenMemoryByWhatWasMeasured) {
  Chunking chunking;
  EXPECT_FALSE(chunking.memory());
  chunking.peak_memory = 100;  // 150 MB with a reserve, and 256 MB for the worker
  EXPECT_EQ(chunking.memory(), 512u);
  chunking.peak_memory = 1024;
  EXPECT_EQ(chunking.memory(), 1792u);
  chunking.wanted_memory = 77;
  EXPECT_EQ(chunking.memory(), 77u);
}

TEST(Manifest, ComesBackAsItWas) {
  const TemporaryFolder folder;
  Bundle bundle = bundle_of(5);
  bundle.inputs = {{"inputs/a.pdb", 12, sha256("a")}};
  bundle.film = Film{"film.mov", {"prores4444", {}, 10, 444, 23.976}};
  bundle.chunking.seconds_per_frame = 0.1;
  folder.file("bundle.json", bundle_json(bundle));
  EXPECT_EQ(bundle_json(read_bundle(folder.path())), bundle_json(bundle));
}

// Reading large files takes long, so their checksums are for `verify`; all sizes are checked. The files are sparse.
TEST(Inputs, AreCheckedBySizeAndUpToAQuarterOfAGibibyteBySum) {
  constexpr std::uint64_t kQuick = std::uint64_t{256} << 20;
  const TemporaryFolder folder;
  const std::string other = sha256("something else"), three = sha256(std::string(3, '\0'));
  const struct {
    std::uint64_t bytes, listed;
    std::string sum;
    bool thorough, refused;
  } cases[]{{3, 3, three, false, false},
            {3, 3, other, false, true},
            {3, 4, three, false, true},
            {kQuick, kQuick, other, false, true},
            {kQuick + 1, kQuick + 1, other, false, false},
            {kQuick + 1, kQuick + 1, other, true, true},
            {kQuick + 1, kQuick + 2, other, false, true}};
  Bundle bundle = bundle_of(1);
  for (const auto& [bytes, listed, sum, thorough, refused] : cases) {
    SCOPED_TRACE(std::to_string(bytes) + " bytes, " + std::to_string(listed) + " listed");
    bundle.inputs = {{"a.xtc", listed, sum}};
    std::filesystem::resize_file(folder.file("a.xtc", ""), bytes);
    if (refused)
      EXPECT_THROW(check_inputs(bundle, folder.path(), thorough), InputError);
    else
      EXPECT_NO_THROW(check_inputs(bundle, folder.path(), thorough));
  }
  bundle.inputs = {{"none.pdb", 0, sha256("")}};
  EXPECT_THROW(check_inputs(bundle, folder.path(), false), InputError);
}

// A picture is whole when its end is there.
TEST(MissingFrames, AreThoseWithoutAWholePicture) {
  const TemporaryFolder folder;
  const std::string end("\0\0\0\0IEND\xae\x42\x60\x82", 12);
  const std::vector<std::string> paths{folder.file("a.png", "picture" + end), folder.file("b.png", "picture"),
                                       folder.file("c.png", ""), (folder.path() / "d.png").string(),
                                       folder.file("e.exr", "any")};
  EXPECT_EQ(missing_files(paths), (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_EQ(missing_files({"nowhere/a.png"}), (std::vector<std::size_t>{0}));
}

TEST(MissingFrames, OfScenesAreThoseWhoseFilesAreNotAsTheirMarkSays) {
  const TemporaryFolder folder;
  Bundle bundle = bundle_of(4);  // frames 0, 3, 6, 9
  bundle.command = {"export", "povray", "inputs/a.pdb"};
  std::filesystem::create_directory(folder.path() / "scene");
  folder.file("scene/a.inc", "1234");
  for (const char* frame : {"0", "3", "6"})
    folder.file(std::string("scene/frame_0000") + frame + ".done", frame[0] == '3'   ? "5 scene/a.inc\n"
                                                                   : frame[0] == '6' ? "4 scene/a.inc\n0 scene/b.inc\n"
                                                                                     : "4 scene/a.inc\n");
  EXPECT_EQ(missing_frames(bundle, folder.path(), Step::surface, bundle.frames), (std::vector<std::uint64_t>{3, 6, 9}));
}

TEST(Engines, AreGivenPlainPathsOnly) {
  const TemporaryFolder folder;
  const Bundle bundle = bundle_of(3);
  for (const Engine& engine : engines()) {
    for (const char* bad :
         {"/mnt/it's", "/mnt/a b", "/mnt/\"x", "/mnt/$x", "/mnt/#IFRAME#", "/mnt/{{x}}", "-x", "a\nb", "\xc3\xa9"})
      EXPECT_THROW(write_job_files(engine, bundle, bad, folder.path()), RequestError) << bad;
    write_job_files(engine, bundle, "/mnt/film-1/a_b.c", folder.path());
    for (const char* file : engine.files)
      for (const char* unknown : {"@COUNT@", "@CORES@", "@MEMORY@", "@GPUS@", "@MINUTES@", "@PATH@"})
        EXPECT_EQ(read_text_file((folder.path() / file).string()).text.find(unknown), std::string::npos)
            << file << unknown;
  }
}

TEST(Templates, AreFilledOnce) {
  const std::string hostile = "it's \"$HOME\" `x` \\ #{}<&>\n;*";
  EXPECT_EQ(test::run_program("/bin/sh", {"-c", "printf %s " + shell_word(hostile)}).out, hostile);
  EXPECT_EQ(filled("@A@ \"$@\" @B@@A@ @C@ a@b", {{"A", "@B@"}, {"B", "2"}}), "@B@ \"$@\" 2@B@ @C@ a@b");
}

TEST(Pictures, LoseTheirDatesAndNothingElse) {
  const auto chunk = [](const std::string& type, const std::string& data) {
    return std::string("\0\0\0", 3) + static_cast<char>(data.size()) + type + data + "CRC!";
  };
  const std::string signature = "\x89PNG\r\n\x1a\n", header = chunk("IHDR", "header"), pixels = chunk("IDAT", "pixels"),
                    end = chunk("IEND", "");
  EXPECT_EQ(png_without_time(signature + header + chunk("tIME", "1234567") + chunk("tEXt", "Date") + pixels +
                             chunk("zTXt", "z") + chunk("gAMA", "gama") + chunk("iTXt", "") + end),
            signature + header + pixels + chunk("gAMA", "gama") + end);
  for (const std::string& broken : {std::string(), std::string("GIF89a"), signature, signature + header + pixels,
                                    signature + header + pixels.substr(0, 10)})
    EXPECT_EQ(png_without_time(broken), std::nullopt);
}

// A program that makes several frames at once dies of one of them before it has reported earlier ones.
TEST(Makers, FindTheFrameThatKillsAProgramWhichMakesSeveralAtOnce) {
  const TemporaryFolder folder;
  const std::string script = folder.file("program", R"(alone=$1; shift
for frame in "$@"; do
  [ $frame = 7 ] && kill -SEGV $$
  [ $alone = no ] && case " $* " in *" 7 "*) kill -SEGV $$;; esac
  echo "{\"frame\":$frame,\"state\":\"done\",\"files\":[]}"
done
)");
  std::vector<std::uint64_t> done, failed;
  FrameListener listener;
  listener.done = [&](std::uint64_t frame, const std::vector<std::string>&, double) { done.push_back(frame); };
  listener.failed = [&](std::uint64_t frame, int, const std::string& error) {
    failed.push_back(frame);
    EXPECT_NE(error.find("signal 11"), std::string::npos) << error;
  };
  const auto command_for = [&](const std::vector<std::uint64_t>& frames, bool alone) {
    std::vector<std::string> words{"/bin/sh", script, alone ? "yes" : "no"};
    for (const std::uint64_t frame : frames) words.push_back(std::to_string(frame));
    return words;
  };
  make_by_lines(command_for, folder.path(), {1, 3, 5, 7, 9}, listener);
  EXPECT_EQ(done, (std::vector<std::uint64_t>{1, 3, 5, 9}));
  EXPECT_EQ(failed, (std::vector<std::uint64_t>{7}));
}

TEST(Children, AreReadAndWaitedFor) {
  const TemporaryFolder folder;
  ChildProcess child({"sh", "-c", "echo one; echo two >&2; printf '%s' \"$PWD\"; exit 7"}, folder.path());
  EXPECT_EQ(child.next_line(), "one");
  EXPECT_EQ(child.next_line(), "two");
  EXPECT_EQ(child.next_line(), folder.path().string());
  EXPECT_EQ(child.next_line(), std::nullopt);
  EXPECT_EQ(child.wait(), 7);
  ChildProcess killed({"sh", "-c", "kill -9 $$"}, folder.path());
  EXPECT_EQ(killed.wait(), 128 + 9);
  EXPECT_THROW(ChildProcess({"no-such-program"}, folder.path()), InputError);
  EXPECT_THROW(ChildProcess({"sh"}, folder.path() / "missing"), InputError);
}

// A worker and its hidden folder both stop children when the program is stopped.
TEST(Children, MayBeStoppedTwice) {
  EXPECT_EXIT(
      {
        ChildProcess child({"sleep", "60"}, "/");
        std::thread waiting([&] { child.wait(); });
        stop_children();
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        stop_children();
        std::_Exit(0);
      },
      testing::ExitedWithCode(0), "");
}

TEST(Children, EndWithTheirObject) {
  const auto begin = std::chrono::steady_clock::now();
  { const ChildProcess child({"sleep", "60"}, "/"); }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

}  // namespace
}  // namespace meniscus::farm
