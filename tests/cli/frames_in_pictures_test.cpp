// SPDX-License-Identifier: BSD-3-Clause
// Pictures, colours, cameras, curves and films of runs of frames.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include <nlohmann/json.hpp>

#include "tests/cli/walking_atoms.h"

namespace meniscus::test {
namespace {

using Json = nlohmann::json;

class FramesInPictures : public WalkingAtoms {};

TEST_F(FramesInPictures, NumberedPictures) {
  const std::string folder = folder_.path().string();
  const std::vector<std::string> view{"render", file_, "-q", "--size", "64x48", "--frames", "1-5:2"};
  const auto render = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = view;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return meniscus(arguments);
  };
  EXPECT_EQ(render({"-o", folder + "/a_###.png"}).exit_code, 0);
  for (const char* name : {"/a_001.png", "/a_003.png", "/a_005.png"})
    EXPECT_TRUE(std::filesystem::exists(folder + name));
  // A share of the run has the run's camera; the visible extent gives the same picture.
  EXPECT_EQ(render({"-o", folder + "/b_###.png", "--only", "3"}).exit_code, 0);
  EXPECT_EQ(read_bytes(folder + "/a_003.png"), read_bytes(folder + "/b_003.png"));
  EXPECT_EQ(render({"-o", folder + "/c_###.png", "--only", "3", "--extent", "visible"}).exit_code, 0);
  EXPECT_EQ(read_bytes(folder + "/a_003.png"), read_bytes(folder + "/c_003.png"));
  EXPECT_NE(read_bytes(folder + "/a_003.png"), read_bytes(folder + "/a_005.png"));
  // A turned camera shows another picture, but the same one after whole turns.
  EXPECT_EQ(render({"-o", folder + "/d_###.png", "--turntable", "0.5"}).exit_code, 0);
  EXPECT_NE(read_bytes(folder + "/d_003.png"), read_bytes(folder + "/a_003.png"));

  const ProgramResult unnumbered = render({"-o", folder + "/a.png"});
  EXPECT_EQ(unnumbered.exit_code, 2);
  EXPECT_NE(unnumbered.err.find("a_#####.png"), std::string::npos) << unnumbered.err;
  EXPECT_EQ(render({"-o", folder + "/a_###.png"}).exit_code, 6);  // the pictures exist
  EXPECT_EQ(meniscus({"render", file_, "-q", "-o", folder + "/z.png", "--turntable", "1"}).exit_code, 2);
}

TEST_F(FramesInPictures, NumbersByFrameColorEachOfThem) {
  const TemporaryFolder folder;
  const std::string run =
      folder.file("run.csv", "frame,index,x\n0,0,0\n0,1,1\n0,2,2\n0,3,3\n1,0,3\n1,1,3\n1,2,0\n1,3,?\n");
  const auto picture = [&](const std::string& name, std::vector<std::string> options) {
    std::vector<std::string> arguments{
        "render", file_, "-q", "--size", "64x48", "--no-provenance", "-o", (folder.path() / name).string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = meniscus(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  };
  const auto bytes = [&](const std::string& name) { return read_bytes(folder.path() / name); };
  picture("run_#.png", {"--frames", "0,1", "--color-by-file", run});
  for (const auto& [frame, numbers] : {std::pair("0", "0 1 2 3"), std::pair("1", "3 3 0 ?")}) {
    const std::string table = folder.file("one", numbers);
    picture("one_#.png",
            {"--frames", "0,1", "--only", frame, "--color-by-file", table, "--color-range", "0:3", "--force"});
    const std::string name = std::string("run_") + frame + ".png";
    EXPECT_TRUE(bytes(name) == bytes(std::string("one_") + frame + ".png")) << frame;
  }
  EXPECT_FALSE(bytes("run_0.png") == bytes("run_1.png"));
  // A frame without numbers fails, the others are made; a single picture is not a frame of a run.
  const ProgramResult gap =
      meniscus({"render", file_, "-q", "--size", "64x48", "-o", (folder.path() / "gap_#.png").string(), "--frames",
                "0-2", "--color-by-file", run});
  EXPECT_EQ(gap.exit_code, 3);
  EXPECT_NE(gap.err.find("holds numbers of 2 frames, 0 to 1, but none of frame 2"), std::string::npos) << gap.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "gap_1.png"));
  const ProgramResult alone =
      meniscus({"render", file_, "-q", "-o", (folder.path() / "a.png").string(), "--color-by-file", run});
  EXPECT_EQ(alone.exit_code, 3);
  EXPECT_NE(alone.err.find("add --frames, or leave out its column frame"), std::string::npos) << alone.err;
  // A repeated frame has the numbers of the trajectory's frame.
  picture("again_#.png", {"--frames", "1", "--repeat", "2", "--color-by-file", run});
  EXPECT_TRUE(bytes("again_2.png") == bytes("again_3.png"));
  picture("second_#.png", {"--frames", "1", "--color-by-file", run});
  EXPECT_TRUE(bytes("again_2.png") == bytes("second_1.png"));
}

// All frames have one scale, whatever the first one contains.
TEST_F(FramesInPictures, WhatColorsMeanIsMeasuredOverTheRun) {
  const TemporaryFolder folder;
  const auto key = [&](const std::string& name, std::vector<std::string> options) {
    std::vector<std::string> arguments{"export",   "blender", file_, "-q",
                                       "--device", "cpu",     "-o",  (folder.path() / name).string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = meniscus(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return Json::parse(read_bytes(folder.path() / name / "surface_sequence.json"))["colors"];
  };
  const auto range = [](const Json& colors) { return colors["range"].get<std::array<double, 2>>(); };
  const auto all = range(key("all", {"--frames", "0-3", "--color", "radial"}));
  std::array<double, 2> widest{1e300, 0.0};
  for (const char* const frame : {"0", "1", "2", "3"}) {
    const auto one = range(key(frame, {"--frames", frame, "--color", "radial"}));
    widest = {std::min(widest[0], one[0]), std::max(widest[1], one[1])};
  }
  EXPECT_EQ(all, widest);
  EXPECT_NE(all, range(key("first", {"--frames", "0", "--color", "radial"})));
  EXPECT_EQ(range(key("asked", {"--frames", "all", "--color", "radial", "--color-range", "0:9"})),
            (std::array<double, 2>{0.0, 9.0}));
  const auto moved = range(key("rmsf", {"--frames", "all", "--color", "rmsf"}));
  EXPECT_EQ(moved[0], 0.0);
  EXPECT_GT(moved[1], 0.0);
}

TEST_F(FramesInPictures, ATurntableTakesEqualStepsAndShowsNoPlaceTwice) {
  const std::string folder = (folder_.path() / "turn").string();
  const ProgramResult result = meniscus(
      {"export", "blender", file_, "-q", "--device", "cpu", "--frames", "0-3", "--turntable", "1", "-o", folder});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json sequence = Json::parse(read_bytes(folder + "/surface_sequence.json"));
  ASSERT_EQ(sequence["frames"].size(), 4u);
  const auto view = [&](std::size_t n, int axis) {
    const Json& camera = sequence["frames"][n % 4]["camera"];
    return camera["target"][axis].get<double>() - camera["position"][axis].get<double>();
  };
  const auto cosine = [&](std::size_t a, std::size_t b) {
    double product = 0, square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      product += view(a, axis) * view(b, axis);
      square += view(a, axis) * view(a, axis);
    }
    return product / square;
  };
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_NEAR(cosine(n, n + 1), 0.0, 1e-9) << "a quarter of a turn, also from the last frame to the first";
    EXPECT_NEAR(cosine(n, n + 2), -1.0, 1e-9);
  }
}

TEST_F(FramesInPictures, Film) {
  const std::string folder = folder_.path().string();
  const std::vector<std::string> view{"render", file_, "-q", "--size", "64x48", "--frames", "all"};
  const auto render = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = view;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return meniscus(arguments);
  };
  for (const char* name : {"/a.mp4", "/b.mp4"}) {
    const ProgramResult result = render({"-o", folder + name, "--fps", "12"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  EXPECT_EQ(read_bytes(folder + "/a.mp4"), read_bytes(folder + "/b.mp4"));
  const ProgramResult probe = run_program(
      "/usr/bin/ffprobe", {"-v", "error", "-count_frames", "-show_entries",
                           "stream=nb_read_frames,width,height,r_frame_rate", "-of", "csv=p=0", folder + "/a.mp4"});
  EXPECT_EQ(probe.out, "64,48,12/1,8\n");
  EXPECT_EQ(render({"-o", folder + "/c.mp4", "--size", "63x48"}).exit_code, 2);
  // A film with a missing frame is not made, and no file remains.
  const std::string bad = folder_.file("bad.pdb", walk(5, 2));
  EXPECT_EQ(meniscus({"render", bad, "-q", "--size", "64x48", "--frames", "all", "-o", folder + "/d.mp4"}).exit_code,
            3);
  const std::vector<std::string> entries = folder_.entries();
  EXPECT_EQ(
      std::ranges::count_if(entries, [](const std::string& name) { return name.find("d.mp4") != std::string::npos; }),
      0);
}

// Each decoded picture of a film is nearest to the picture of its own frame, and there is one for each frame.
TEST_F(FramesInPictures, AFilmShowsEachFrameInItsPlace) {
  const std::string folder = folder_.path().string();
  const std::vector<std::string> view{"render", file_, "-q",        "--size", "64x48",        "--frames", "all",
                                      "--jobs", "3",   "--samples", "1",      "--background", "white",    "-o"};
  for (const char* output : {"/f.mkv", "/f_##.png"}) {
    std::vector<std::string> words = view;
    words.push_back(folder + output);
    if (output == std::string("/f.mkv")) words.insert(words.end(), {"--crf", "1", "--chroma", "444"});
    const ProgramResult made = meniscus(words);
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  const auto decoded = [&](const std::string& input) {
    const ProgramResult result =
        run_program("/usr/bin/ffmpeg", {"-v", "error", "-i", input, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  };
  constexpr std::size_t kPicture = 64 * 48 * 3;
  const std::string film = decoded(folder + "/f.mkv"), pictures = decoded(folder + "/f_%02d.png");
  ASSERT_EQ(film.size(), 8 * kPicture);
  ASSERT_EQ(pictures.size(), 8 * kPicture);
  for (std::size_t n = 0; n < 8; ++n) {
    std::vector<double> differences(8, 0.0);
    for (std::size_t other = 0; other < 8; ++other)
      for (std::size_t byte = 0; byte < kPicture; ++byte)
        differences[other] += std::abs(static_cast<unsigned char>(film[n * kPicture + byte]) -
                                       static_cast<unsigned char>(pictures[other * kPicture + byte]));
    EXPECT_EQ(std::ranges::min_element(differences) - differences.begin(), static_cast<std::ptrdiff_t>(n));
    EXPECT_LT(differences[n] / kPicture, 3.0);
  }
}

TEST_F(FramesInPictures, ACurveGoesAlong) {
  const std::string folder = folder_.path().string(), table = folder + "/series.csv";
  ASSERT_EQ(meniscus({"surface", file_, "-q", "--frames", "all", "--csv-series", table}).exit_code, 0);
  const auto render = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"render",
                                   file_,
                                   "-q",
                                   "--size",
                                   "200x150",
                                   "--samples",
                                   "1",
                                   "--frames",
                                   "all",
                                   "-o",
                                   folder + "/c_##.png",
                                   "--force",
                                   "--no-provenance"};
    words.insert(words.end(), more.begin(), more.end());
    return meniscus(words);
  };
  ASSERT_EQ(render({"--curve", table}).exit_code, 0);
  const std::string whole = read_bytes(folder + "/c_05.png"), other = read_bytes(folder + "/c_06.png");
  // A share of the run has the same pictures; with another column, without a curve and in another frame they differ.
  ASSERT_EQ(render({"--curve", table, "--only", "5"}).exit_code, 0);
  EXPECT_EQ(read_bytes(folder + "/c_05.png"), whole);
  ASSERT_EQ(render({"--curve", table, "--curve-column", "volume", "--only", "5"}).exit_code, 0);
  EXPECT_NE(read_bytes(folder + "/c_05.png"), whole);
  const auto refused = [&](std::vector<std::string> more, int code, const std::string& words) {
    const ProgramResult result = render(std::move(more));
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  };
  refused({"--curve", table, "--curve-column", "depth"}, 3,
          "series.csv:1: has no column 'depth'; it has time, ses_area");
  refused({"--curve", folder_.file("short.csv", "frame,time,volume\n0,,1\n1,,2\n")}, 3, "has no row for frame 2");
  refused({"--curve", folder_.file("twice.csv", "frame,volume\n0,1\n0,2\n")}, 3,
          "twice.csv:3: frame 0 appears a second time");
  refused({"--curve", folder_.file("word.csv", "frame,volume\n0,many\n")}, 3,
          "word.csv:2: volume 'many' is not a number");
  refused({"--curve", folder_.file("none.csv", "a,b\n")}, 3, "none.csv:1: is not a header with a column 'frame'");
  refused({"--curve-column", "volume"}, 2, "--curve");
  const ProgramResult one = meniscus({"render", file_, "-q", "-o", folder + "/one.png", "--curve", table});
  EXPECT_EQ(one.exit_code, 2);
  EXPECT_NE(one.err.find("--curve has no effect: there is no run of frames"), std::string::npos) << one.err;
}

TEST_F(FramesInPictures, FilmWithoutFfmpegSaysSo) {
  const ProgramResult result =
      run_program("/usr/bin/env", {"PATH=/nowhere", meniscus_program(), "render", file_, "-q", "--size", "64x48",
                                   "--frames", "all", "-o", folder_.path().string() + "/a.mp4"});
  EXPECT_EQ(result.exit_code, 6);
  EXPECT_NE(result.err.find("need the program ffmpeg"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace meniscus::test
