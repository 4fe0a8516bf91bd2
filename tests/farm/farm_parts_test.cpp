// SPDX-License-Identifier: BSD-3-Clause
// The small parts of a farm, each alone: checksums, chunks, quotes, children, pictures without dates.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <gtest/gtest.h>

#include "app/farm/bundle.h"
#include "app/farm/check_scene.h"
#include "app/farm/checksum.h"
#include "app/farm/child_process.h"
#include "app/farm/claims.h"
#include "app/farm/command_options.h"
#include "app/farm/emit.h"
#include "app/farm/frame_record.h"
#include "app/farm/inner_path.h"
#include "app/farm/makers.h"
#include "app/farm/quote.h"
#include "app/farm/png_without_time.h"
#include "app/farm/worker.h"
#include "app/process/program_error.h"
#include "core/base/text.h"
#include "app/farm/check_bundle.h"
#include "tests/support/run_program.h"

namespace meniscus::farm {
namespace {

using test::TemporaryFolder;

Bundle bundle_of(std::uint64_t frames) {
  Bundle bundle;
  bundle.program_version = "1";
  bundle.command = {"render", "inputs/a.pdb"};
  for (std::uint64_t n = 0; n < frames; ++n) bundle.frames.push_back(3 * n);
  bundle.steps = {{"render", Maker::meniscus, {}}};
  bundle.width = bundle.height = 10;
  return bundle;
}

// The examples of FIPS 180-4, and a file that takes several readings.
TEST(Checksum, IsSha256) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  const TemporaryFolder folder;
  const std::string million(1'000'000, 'a'), more(3'000'000, 'b');
  EXPECT_EQ(sha256_of_file(folder.file("a", million)),
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

TEST(Chunks, AreAsLongAsWishedAndNeverTooMany) {
  const auto decided = [](std::uint64_t frames, double minutes, double seconds) {
    Chunking chunking;
    chunking.asked_minutes = minutes;
    chunking.seconds_per_frame = seconds;
    chunking.decide(frames);
    return chunking.count;
  };
  EXPECT_EQ(decided(100, 5, 30), 10u);
  EXPECT_EQ(decided(100, 5, 1000), 100u);
  EXPECT_EQ(decided(100, 5, 0.001), 1u);
  EXPECT_EQ(decided(100'000, 5, 1000), 1000u);
  EXPECT_EQ(decided(1, 5, 1e9), 1u);
  Chunking one_each;
  one_each.asked_frames = 1;
  one_each.decide(3000);
  EXPECT_EQ(one_each.count, 1000u);
  EXPECT_EQ(one_each.wanted_count(3000), 3000u);
  Chunking by_frames;
  by_frames.asked_frames = 7;
  by_frames.decide(15);
  EXPECT_EQ(by_frames.count, 3u);
}

TEST(Tries, WaitTwiceAsLongEachTimeAndNeverMoreThanAnHour) {
  EXPECT_EQ(Tries{}.wait_after(1), std::nullopt);
  const Tries three{3, 10.0}, many{100, 10.0};
  EXPECT_EQ(three.wait_after(1), 10.0);
  EXPECT_EQ(three.wait_after(2), 20.0);
  EXPECT_EQ(three.wait_after(3), std::nullopt);
  EXPECT_EQ(many.wait_after(10), 3600.0);
  EXPECT_EQ(many.wait_after(99), 3600.0);
}

TEST(Tasks, AreGivenMemoryByWhatWasMeasured) {
  Chunking chunking;
  EXPECT_FALSE(chunking.memory());
  chunking.peak_memory = 100;  // 150, and 256 for the worker
  EXPECT_EQ(chunking.memory(), 512u);
  chunking.peak_memory = 1024;
  EXPECT_EQ(chunking.memory(), 1792u);
  chunking.asked_memory = 77;
  EXPECT_EQ(chunking.memory(), 77u);
}

TEST(CommandOptions, AreSaidAgainInOneWay) {
  const auto again = [](const std::vector<std::string>& words) { return as_words(read_command_options(words)); };
  using Words = std::vector<std::string>;
  EXPECT_EQ(again({"--select", "--force", "--light", "1", "2", "3", "--whole", "-q", "--probe=-1"}),
            (Words{"--select=--force", "--light=1,2,3", "--whole", "-q", "--probe=-1"}));
  EXPECT_EQ(again({"--whole", "guess", "--radius", "name CA=2", "--light", "1,2,3"}),
            (Words{"--whole=guess", "--radius=name CA=2", "--light=1,2,3"}));
  EXPECT_TRUE(read_command_options({"--camera", "a"}).front().reads_file);
  for (const Words& bad : {Words{"--save-camera", "x"}, Words{"--output=x"}, Words{"word"}, Words{"--"}, Words{""},
                           Words{"--select"}, Words{"--select="}, Words{"-q=1"}, Words{"--sel", "all"}})
    EXPECT_THROW(read_command_options(bad), RequestError) << bad.front();
  EXPECT_THROW(check_povray_options({"+Q" + std::string(10'000'000, '1')}), RequestError);
  for (const char* chooses_frame :
       {"surface.ini[film]", "surface.ini[Film]", "Declare=Meniscus_By_Place=1", "Declare=Meniscus_Frame=3"})
    EXPECT_THROW(check_povray_options({chooses_frame}), RequestError) << chooses_frame;
  EXPECT_NO_THROW(check_povray_options({"+A0.1", "-A", "+AM2", "+Q9", "surface.ini[ghost]", "Declare=Meniscus_A=1"}));
}

TEST(InnerPaths, StayBelowTheFolder) {
  for (const char* fine : {"a", "inputs/a.pdb", "a/b-c/d_e.F9"}) EXPECT_TRUE(is_inner_path(fine)) << fine;
  for (const char* bad : {"", "/a", "a/", "a//b", "../a", "a/..", ".", ".a", "a/.b", "-a", "a b", "a\nb", "a\\b", "é"})
    EXPECT_FALSE(is_inner_path(bad)) << bad;
  const TemporaryFolder folder;
  folder.file("file", "text");
  std::filesystem::create_symlink("/etc", folder.path() / "link");
  EXPECT_EQ(inner_entry(folder.path(), "file"), Entry::file);
  EXPECT_EQ(inner_entry(folder.path(), "none/file"), Entry::nothing);
  EXPECT_EQ(inner_text(folder.path(), "file", 4), "text");
  EXPECT_THROW(inner_text(folder.path(), "file", 3), InputError);
  EXPECT_THROW(inner_entry(folder.path(), "link"), InputError);
  EXPECT_THROW(inner_entry(folder.path(), "link/passwd"), InputError);
}

TEST(Scenes, AreReadAsPovrayReadsThem) {
  for (const char* fine :
       {"", "#declare Meniscus_A = 1e-5; // a \"b\" #fopen\n", "#include \"surface_style.inc\"",
        "#error concat(\"no frame \", str(1, 0, 0), \"; so.\\n\")", "sphere{<1.5,-2.,.3>,1e5 inverse}"})
    EXPECT_EQ(wrong_in_scene(fine), "") << fine;
  for (const char* bad : {"#fopen F", "# \n\tfopen F", "#//\nfopen F", "#", "/* */", "\"surface", "\"a/b c\"",
                          "\"strings\"", "\"a \\\" b\"", "\"a \\u002f\"", "chr(47)", "1e5chr(47)", "a\rb", "// a\rb\n",
                          "@", "Chr", "\"\"", "#macro M()", "// a\v#fopen"})
    EXPECT_NE(wrong_in_scene(bad), "") << bad;
  EXPECT_EQ(wrong_in_settings("; words\nWidth=40\n\n[glass]\nDeclare=Meniscus_Material=2\n"), "");
  EXPECT_EQ(wrong_in_settings("Width=40\nPre_Scene_Command=id\nHeight=30\n"), "Pre_Scene_Command=id");
  EXPECT_NE(wrong_in_settings("Width=40 +O/x"), "");
  // Long texts are no way to a crash.
  EXPECT_NE(wrong_in_scene('"' + std::string(10'000'000, ' ') + '"'), "");
  EXPECT_NE(wrong_in_settings(';' + std::string(10'000'000, ' ')), "");
}

TEST(Manifest, ComesBackAsItWas) {
  const TemporaryFolder folder;
  Bundle bundle = bundle_of(5);
  bundle.inputs = {{"inputs/a.pdb", 12, sha256("a")}};
  bundle.film = Film{"film.mov", 23.976, {"prores4444", {}, 10, 444}};
  bundle.chunking.seconds_per_frame = 0.1;
  bundle.chunking.decide(5);
  bundle.tries = {4, 2.5};
  bundle.inputs[0].source = "/data/a.pdb";
  folder.file("bundle.json", bundle_json(bundle));
  const Bundle read = read_bundle(folder.path());
  EXPECT_EQ(bundle_json(read), bundle_json(bundle));
  EXPECT_EQ(read.fingerprint(), bundle.fingerprint());
  EXPECT_EQ(read.place_of(9), 3u);
  EXPECT_THROW(read.place_of(10), RequestError);
  // What was measured is not what was asked for; everything else is.
  Bundle other = bundle;
  other.chunking.seconds_per_frame = 7.0;
  EXPECT_TRUE(same_but_for_measurement(bundle, other));
  // Where an input is and how often frames are tried changes no frame.
  other.inputs[0].source = "/elsewhere/a.pdb";
  other.tries = {};
  EXPECT_FALSE(same_but_for_measurement(bundle, other));
  EXPECT_EQ(other.fingerprint(), bundle.fingerprint());
  other.inputs[0].sha256 = sha256("b");
  EXPECT_FALSE(same_but_for_measurement(bundle, other));
  EXPECT_NE(other.fingerprint(), bundle.fingerprint());
}

// Checksums of what takes long to read are for `verify`; sizes are always looked at. The files are sparse.
TEST(Inputs, AreCheckedBySizeAndUpToAQuarterOfAGibibyteBySum) {
  constexpr std::uint64_t kQuick = std::uint64_t{256} << 20;
  const TemporaryFolder folder;
  const auto refused = [&](std::uint64_t bytes, std::uint64_t said, const std::string& sum, bool thorough) {
    Bundle bundle = bundle_of(1);
    bundle.inputs = {{"a.xtc", said, sum}};
    std::filesystem::resize_file(folder.file("a.xtc", ""), bytes);
    try {
      check_inputs(bundle, folder.path(), thorough);
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("a.xtc"), std::string::npos) << error.what();
      return true;
    }
    return false;
  };
  const std::string other = sha256("something else");
  EXPECT_FALSE(refused(3, 3, sha256(std::string(3, '\0')), false));
  EXPECT_TRUE(refused(3, 3, other, false));
  EXPECT_TRUE(refused(3, 4, sha256(std::string(3, '\0')), false));
  EXPECT_TRUE(refused(kQuick, kQuick, other, false)) << "this large is quick enough";
  EXPECT_FALSE(refused(kQuick + 1, kQuick + 1, other, false)) << "larger files are not read at the start";
  EXPECT_TRUE(refused(kQuick + 1, kQuick + 1, other, true)) << "but when one asks for all of it";
  EXPECT_TRUE(refused(kQuick + 1, kQuick + 2, other, false)) << "their size is known at once";
  EXPECT_TRUE(refused(2 * kQuick, kQuick + 1, other, false));
  Bundle missing = bundle_of(1);
  missing.inputs = {{"none.pdb", 0, sha256("")}};
  EXPECT_THROW(check_inputs(missing, folder.path(), false), InputError);
}

TEST(Records, CountForTheirBundleAndTheirFrameAndTheFilesTheyName) {
  const TemporaryFolder folder;
  const Bundle bundle = bundle_of(3);
  const FrameRecords records(folder.path(), bundle);
  EXPECT_EQ(records.read("render", 3), std::nullopt);
  std::filesystem::create_directory(folder.path() / "images");
  folder.file("images/a.png", "picture");
  folder.file("images/b.png", "another");
  const FrameRecord made = records.measured(3, {"images/a.png", "images/b.png"}, 1.5);
  ASSERT_EQ(made.files.size(), 2u);
  EXPECT_EQ(made.files[0].bytes, 7u);
  EXPECT_EQ(made.files[1].sha256, sha256("another"));
  records.write("render", made);
  const std::optional<FrameRecord> read = records.read("render", 3);
  ASSERT_TRUE(read && read->done());
  EXPECT_EQ(read->seconds, 1.5);
  EXPECT_EQ(records.fault(*read), "");
  EXPECT_EQ(records.read("surface", 3), std::nullopt) << "each step has its own";
  Bundle other = bundle;
  other.command.push_back("--probe");
  EXPECT_EQ(FrameRecords(folder.path(), other).read("render", 3), std::nullopt) << "another bundle";
  std::filesystem::copy_file(folder.path() / "state/render/frame_00003.json",
                             folder.path() / "state/render/frame_00006.json");
  EXPECT_EQ(records.read("render", 6), std::nullopt) << "the record of another frame";

  folder.file("images/b.png", "anotheR");
  EXPECT_EQ(records.fault(*read), "images/b.png: is not what was made (SHA-256)");
  EXPECT_EQ(records.fault(*read, Look::sizes), "") << "a quick look does not read";
  folder.file("images/b.png", "");
  EXPECT_EQ(records.fault(*read, Look::sizes), "images/b.png: has 0 bytes, not 7");
  std::filesystem::remove(folder.path() / "images/a.png");
  EXPECT_EQ(records.fault(*read, Look::sizes), "images/a.png: is missing");
  EXPECT_EQ(records.fault(FrameRecord{}), "its record names no file");

  FrameRecord failed;
  failed.frame = 3;
  failed.exit_code = 4;
  failed.error = "no \"luck\"";
  records.write("render", failed);
  const std::optional<FrameRecord> again = records.read("render", 3);
  ASSERT_TRUE(again);
  EXPECT_FALSE(again->done());
  EXPECT_EQ(again->exit_code, 4);
  EXPECT_EQ(again->error, failed.error);
  folder.file("state/render/frame_00003.json", "{\"frame\": 3, \"state\"");
  EXPECT_EQ(records.read("render", 3), std::nullopt) << "damaged";
}

std::size_t claims_in(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    count += entry.path().filename().string().find(".claim") != std::string::npos;
  return count;
}

// As when a signal comes at any moment of a worker that takes and gives back.
TEST(Claims, AreLeftByNobodyWhoGaveAllBack) {
  for (int round = 0; round < 20; ++round) {
    const TemporaryFolder folder;
    Claims claims(folder.path());
    std::atomic<std::uint64_t> taken = 0;
    std::thread worker([&] {
      for (std::uint64_t frame = 0; frame < 5000 && claims.take("render", frame); ++frame) {
        if (frame % 3 == 0) claims.give_back("render", frame);
        ++taken;
      }
    });
    while (taken < 5) std::this_thread::yield();
    give_back_all_claims();
    worker.join();
    EXPECT_EQ(claims_in(folder.path()), 0u) << "round " << round << ", " << taken << " taken";
    EXPECT_FALSE(claims.take("render", 1'000'000));
    if (HasFailure()) return;
  }
}

TEST(Quotes, HoldAnything) {
  const std::string hostile = "it's \"$HOME\" `x` \\ #{}<&>\n;*";
  const test::ProgramResult said = test::run_program("/bin/sh", {"-c", "printf %s " + shell_word(hostile)});
  EXPECT_EQ(said.out, hostile);
  EXPECT_EQ(xml_text("<a b=\"c\" d='&'>"), "&lt;a b=&quot;c&quot; d=&apos;&amp;&apos;&gt;");
  EXPECT_EQ(json_text("\"\\\u2028"), "\"\\\"\\\\\\u2028\"");
  EXPECT_NO_THROW(require_printable_path("x", "/a b/é'\"$"));
  for (const char* bad : {"a\nb", "a\x7f", "\xff\xfe"}) EXPECT_THROW(require_printable_path("x", bad), RequestError);
}

TEST(Templates, AreFilledOnce) {
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
    EXPECT_THROW(png_without_time(broken), RunError);
}

// A program that makes several frames at once dies of one of them before it has told the earlier ones.
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
  listener.tried_again = [](std::uint64_t, const std::string&) {};
  listener.said = [](const std::string&) {};
  const auto command_for = [&](const std::vector<std::uint64_t>& frames, bool alone) {
    std::vector<std::string> words{"/bin/sh", script, alone ? "yes" : "no"};
    for (const std::uint64_t frame : frames) words.push_back(std::to_string(frame));
    return words;
  };
  make_by_lines(command_for, folder.path(), {1, 3, 5, 7, 9}, listener);
  EXPECT_EQ(done, (std::vector<std::uint64_t>{1, 3, 5, 9}));
  EXPECT_EQ(failed, (std::vector<std::uint64_t>{7}));
}

// What a program says while it makes several frames at once is in no frame's log: a later frame's line would be in that
// of the first one that is over. Once it makes one after another each frame has its own.
TEST(Makers, HearOnlyWhatIsKnownToBeOfTheFrame) {
  const TemporaryFolder folder;
  const std::string script = folder.file("program", R"(alone=$1; shift
echo opened
if [ $alone = no ]; then
  echo '{"event":"start","frames":3,"at_once":3}'
  echo "of frame 7"
  echo '{"frame":1,"state":"done","files":[]}'
  echo "of frame 7, again"
  kill -SEGV $$
fi
echo '{"event":"start","frames":2,"at_once":1}'
for frame in "$@"; do
  echo "of frame $frame"
  [ $frame = 7 ] && kill -SEGV $$
  echo "{\"frame\":$frame,\"state\":\"done\",\"files\":[]}"
done
)");
  std::map<std::uint64_t, std::vector<std::string>> logs;
  std::vector<std::string> log;
  FrameListener listener;
  listener.done = [&](std::uint64_t frame, const std::vector<std::string>&, double) {
    logs[frame] = std::exchange(log, {});
  };
  listener.failed = [&](std::uint64_t frame, int, const std::string&) { logs[frame] = std::exchange(log, {}); };
  listener.tried_again = [&](std::uint64_t frame, const std::string& error) {
    log.push_back(
        fmt::format("{} again{}", frame, error.find("several") == std::string::npos ? "" : ", one of several"));
  };
  listener.said = [&](const std::string& line) { log.push_back(line); };
  const auto command_for = [&](const std::vector<std::uint64_t>& frames, bool alone) {
    std::vector<std::string> words{"/bin/sh", script, alone ? "yes" : "no"};
    for (const std::uint64_t frame : frames) words.push_back(std::to_string(frame));
    return words;
  };
  make_by_lines(command_for, folder.path(), {1, 5, 7}, listener);
  EXPECT_EQ(logs, (std::map<std::uint64_t, std::vector<std::string>>{
                      {1, {"opened"}},
                      {5, {"5 again, one of several", "opened", "of frame 5"}},
                      {7, {"of frame 7", "7 again", "opened", "of frame 7"}}}));
}

TEST(Children, AreHeardAndWaitedFor) {
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

TEST(Children, EndWithTheirObject) {
  const auto begin = std::chrono::steady_clock::now();
  { const ChildProcess child({"sleep", "60"}, "/"); }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

}  // namespace
}  // namespace meniscus::farm
