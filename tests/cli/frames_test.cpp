// SPDX-License-Identifier: BSD-3-Clause
// Runs of frames as a user makes them: which frames, what is prepared, what fails and how it is told.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

namespace meniscus::test {
namespace {

using Json = nlohmann::json;

std::string atom_line(int serial, const char* name, double x, double y, double z, const char* element) {
  return fmt::format("ATOM  {:>5} {:<4} ALA A   1    {:>8.3f}{:>8.3f}{:>8.3f}  1.00 10.00          {:>2}\n", serial,
                     name, x, y, z, element);
}

/// Four atoms whose last one walks away, and the whole of which turns and drifts.
std::string walk(int frames, int bad_frame = -1) {
  std::string text;
  for (int frame = 0; frame < frames; ++frame) {
    const double turn = 0.3 * frame, c = std::cos(turn), s = std::sin(turn);
    text += fmt::format("MODEL     {:>4}\n", frame + 1);
    const double sites[4][3] = {{0, 0, 0}, {1.5, 0, 0}, {2.0, 1.4, 0}, {1.2, 2.4 + 0.5 * frame, 0.3}};
    const char* names[4] = {" N", " CA", " C", " O"};
    for (int n = 0; n < 4; ++n) {
      std::string line =
          atom_line(n + 1, names[n], c * sites[n][0] - s * sites[n][1] + frame, s * sites[n][0] + c * sites[n][1],
                    sites[n][2], names[n] + 1 == std::string("CA") ? "C" : names[n] + 1);
      if (frame == bad_frame && n == 2) line.replace(30, 8, "     nan");
      text += line;
    }
    text += "ENDMDL\n";
  }
  return text + "END\n";
}

ProgramResult meniscus(std::vector<std::string> arguments) { return run_program(MENISCUS_PROGRAM, arguments); }

std::vector<Json> lines_of(const std::string& text) {
  std::vector<Json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with('{')) lines.push_back(Json::parse(line));
  return lines;
}

class Frames : public ::testing::Test {
 protected:
  std::vector<Json> surface(std::vector<std::string> options) {
    std::vector<std::string> arguments{"surface", file_, "--json", "-q"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = meniscus(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return lines_of(result.out);
  }
  std::vector<int> numbers(std::vector<std::string> options) {
    std::vector<int> numbers;
    for (const Json& line : surface(options)) numbers.push_back(line["frame"]);
    return numbers;
  }
  void expect_error(std::vector<std::string> options, int exit_code, const std::string& words) {
    std::vector<std::string> arguments{"surface", file_, "-q"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = meniscus(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  }

  TemporaryFolder folder_;
  std::string file_ = folder_.file("walk.pdb", walk(8));
};

TEST_F(Frames, EachIsTheSurfaceOfItsModel) {
  const std::vector<Json> frames = surface({"--frames", "all"});
  ASSERT_EQ(frames.size(), 8u);
  for (int n = 0; n < 8; ++n) {
    const ProgramResult single = meniscus({"surface", file_, "--json", "-q", "--model", std::to_string(n + 1)});
    const Json model = Json::parse(single.out);
    EXPECT_EQ(frames[n]["area"], model["area"]) << n;
    EXPECT_EQ(frames[n]["volume"], model["volume"]) << n;
    EXPECT_EQ(frames[n]["certificate"]["closed"], true);
  }
  EXPECT_NE(frames[0]["area"], frames[7]["area"]);
}

TEST_F(Frames, WhichOnes) {
  EXPECT_EQ(numbers({"--frames", "0-7:3,5"}), (std::vector<int>{0, 3, 6, 5}));
  EXPECT_EQ(numbers({"--stride", "3"}), (std::vector<int>{0, 3, 6}));
  EXPECT_EQ(numbers({"--begin", "2", "--end", "5", "--stride", "2"}), (std::vector<int>{2, 4}));
  EXPECT_EQ(numbers({"--frames", "all", "--only", "6,1"}), (std::vector<int>{6, 1}));
  EXPECT_EQ(numbers({"--repeat", "3", "--frames", "0-5"}).size(), 6u);
  const std::vector<Json> slow = surface({"--repeat", "3", "--frames", "2-3"});
  EXPECT_EQ(slow[0]["area"], surface({"--frames", "0"})[0]["area"]);
  EXPECT_EQ(slow[1]["area"], surface({"--frames", "1"})[0]["area"]);
}

TEST_F(Frames, SharesAreTheRun) {
  const std::vector<std::string> prepared{"--frames", "all", "--superpose", "name N CA C", "--smooth", "3"};
  const std::vector<Json> run = surface(prepared);
  for (const char* share : {"5", "0", "7"}) {
    std::vector<std::string> options = prepared;
    options.insert(options.end(), {"--only", share});
    EXPECT_EQ(surface(options)[0]["area"], run[std::stoul(share)]["area"]);
  }
}

TEST_F(Frames, SuperpositionMovesButDoesNotChange) {
  const std::vector<Json> plain = surface({"--frames", "all"}),
                          moved = surface({"--frames", "all", "--superpose", "name N CA C"});
  for (int n = 0; n < 8; ++n) EXPECT_NEAR(plain[n]["area"].get<double>(), moved[n]["area"].get<double>(), 1e-6);
}

/// An alanine without hydrogens in boxes of 2 nm (the second one sheared), moved by `shift` nm and cut at the faces.
std::string cut_gro(double shift) {
  const double sites[5][3] = {{0, 0, 0}, {0.146, 0, 0}, {0.201, 0.142, 0}, {0.125, 0.239, 0}, {0.199, -0.077, -0.12}};
  const char* names[5] = {"N", "CA", "C", "O", "CB"};
  std::string text;
  for (int frame = 0; frame < 2; ++frame) {
    text += fmt::format("alanine t= {:.1f}\n5\n", 10.0 * frame);
    for (int n = 0; n < 5; ++n) {
      double x = sites[n][0] + shift, y = sites[n][1] + shift;
      if (y >= 2.0) {
        y -= 2.0;
        if (frame == 1) x -= 0.5;  // the sheared box's b is (0.5, 2, 0)
      }
      if (x >= 2.0) x -= 2.0;
      text += fmt::format("    1ALA  {:>5}{:>5}{:>8.3f}{:>8.3f}{:>8.3f}\n", names[n], n + 1, x, y, sites[n][2] + 1.0);
    }
    text += frame == 0 ? "2 2 2\n" : "2 2 2 0 0 0.5 0 0 0\n";
  }
  return text;
}

TEST_F(Frames, MoleculesAcrossTheBoxAreMadeWhole) {
  const std::string whole = folder_.file("whole.gro", cut_gro(0.5)), cut = folder_.file("cut.gro", cut_gro(1.9));
  const auto areas = [&](const std::string& file, std::vector<std::string> more) {
    std::vector<std::string> arguments{"surface", file, "--json", "-q", "--frames", "all"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = meniscus(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::vector<double> found;
    for (const Json& line : lines_of(result.out)) found.push_back(line["area"]);
    return found;
  };
  const std::vector<double> right = areas(whole, {}), broken = areas(cut, {});
  ASSERT_EQ(right.size(), 2u);
  for (const std::vector<std::string>& option : {std::vector<std::string>{"--whole"}, {"--whole", "guess"}}) {
    const std::vector<double> mended = areas(cut, option);
    for (int frame = 0; frame < 2; ++frame) {
      EXPECT_NEAR(mended[frame], right[frame], 1e-6);
      EXPECT_GT(broken[frame], right[frame] + 10.0);
    }
  }
  EXPECT_EQ(meniscus({"surface", cut, "--begin", "5ps", "--json", "-q"}).out.find("\"frame\":1"), 1u);
}

TEST_F(Frames, WrongRequests) {
  expect_error({"--frames", "0-8"}, 2, "asks for frame 8; there are 8, 0 to 7");
  expect_error({"--frames", "5-2"}, 2, "runs backwards");
  expect_error({"--frames", "0-3", "--only", "5"}, 2, "frame 5 is not in the run");
  expect_error({"--begin", "5", "--end", "3"}, 2, "no frame is left");
  expect_error({"--begin", "3ps"}, 2, "have no times");
  expect_error({"--begin", "soon"}, 2, "neither a frame");
  expect_error({"--frames", "all", "--smooth", "4"}, 2, "odd");
  expect_error({"--frames", "all", "--superpose", "name CA"}, 2, "selects 1 of 4 atoms, and needs at least 3");
  expect_error({"--frames", "all", "--model", "2"}, 2, "leave --model away");
  expect_error({"--frames", "all", "--reference", "8"}, 2, "0 to 7");
  expect_error({"--frames", "0", "--whole"}, 3, "frame 0: has no periodic box");
  const std::string other = folder_.file("other.xyz", "2\n\nC 0 0 0\nC 0 0 2\n");
  expect_error({"--trajectory", other}, 3, "its frames have 2 atoms");
}

TEST_F(Frames, GoOnAfterABadOne) {
  const std::string file = folder_.file("bad.pdb", walk(5, 2));
  const ProgramResult result = meniscus({"surface", file, "--json", "--progress", "json", "--frames", "all"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(lines_of(result.out).size(), 4u);
  EXPECT_NE(result.err.find("1 of 5 frames failed; the first, frame 2: "), std::string::npos) << result.err;
  const std::vector<Json> progress = lines_of(result.err);
  ASSERT_EQ(progress.size(), 7u);
  EXPECT_EQ(progress[0]["frames"], 5);
  EXPECT_EQ(progress[3]["state"], "failed");
  EXPECT_EQ(progress[3]["frame"], 2);
  EXPECT_EQ(progress[3]["exit"], 3);
  EXPECT_EQ(progress[6]["done"], 4);
}

/// Everything below a folder: paths and contents.
std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) {
      std::ifstream file(entry.path(), std::ios::binary);
      files[std::filesystem::relative(entry.path(), folder).string()] = {std::istreambuf_iterator<char>(file), {}};
    }
  return files;
}

TEST_F(Frames, AreTheSameHoweverManyAreMadeAtOnce) {
  const auto numbers_of = [&](const char* jobs) {
    std::vector<Json> lines = surface({"--frames", "all", "--jobs", jobs});
    for (Json& line : lines) line.erase("stages");
    return lines;
  };
  ASSERT_EQ(numbers_of("1").size(), 8u);
  EXPECT_EQ(numbers_of("1"), numbers_of("3"));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"export", "povray"}, {"export", "blender"}, {"render", "--size", "60x40"}}) {
    std::map<std::string, std::string> first;
    for (const std::string jobs : {"1", "3"}) {
      const std::filesystem::path out = folder_.path() / (command.back() + jobs);
      std::filesystem::create_directory(out);
      std::vector<std::string> words = command;
      const std::string output = command.front() == "render" ? (out / "f_##.png").string() : (out / "run").string();
      words.insert(words.end(), {file_, "-q", "--frames", "all", "--jobs", jobs, "-o", output});
      const ProgramResult result = meniscus(words);
      ASSERT_EQ(result.exit_code, 0) << result.err;
      const auto files = contents(out);
      EXPECT_GE(files.size(), 8u) << command.back();
      if (jobs == "1") first = files;
      EXPECT_TRUE(files == first) << command.back();
    }
  }
}

// GL belongs to one thread, so what is verified by it is made one after another.
TEST_F(Frames, AreVerifiedHoweverManyAreAskedFor) {
  EXPECT_EQ(surface({"--frames", "all", "--verify", "--jobs", "3"}).size(), 8u);
}

TEST_F(Frames, FailInTheirOrderHoweverManyAreMadeAtOnce) {
  const std::string bad = folder_.file("bad.pdb", walk(8, 3));
  for (const char* jobs : {"1", "4"}) {
    const ProgramResult result =
        meniscus({"surface", bad, "--frames", "all", "--json", "--progress", "json", "--jobs", jobs});
    EXPECT_EQ(result.exit_code, 3) << result.err;
    std::vector<int> said;
    for (const Json& line : lines_of(result.err))
      if (line["event"] == "frame") said.push_back(line["frame"]);
    EXPECT_EQ(said, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7})) << result.err;
    EXPECT_EQ(lines_of(result.out).size(), 7u) << result.out;
    EXPECT_NE(result.err.find("1 of 8 frames failed; the first, frame 3"), std::string::npos) << result.err;
  }
  const ProgramResult none = meniscus({"surface", file_, "--frames", "all", "--jobs", "0"});
  EXPECT_EQ(none.exit_code, 2);
}

TEST_F(Frames, OpenjdLinesAreOnStandardOutput) {
  const ProgramResult result = meniscus({"surface", file_, "-q", "--frames", "0-1", "--progress", "openjd"});
  EXPECT_NE(result.out.find("openjd_progress: 50.0\n"), std::string::npos);
  EXPECT_NE(result.out.find("openjd_progress: 100.0\n"), std::string::npos);
}

TEST_F(Frames, NumberedPictures) {
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
  // A share has the camera of the run; the visible extent gives the same picture.
  EXPECT_EQ(render({"-o", folder + "/b_###.png", "--only", "3"}).exit_code, 0);
  EXPECT_EQ(read_bytes(folder + "/a_003.png"), read_bytes(folder + "/b_003.png"));
  EXPECT_EQ(render({"-o", folder + "/c_###.png", "--only", "3", "--extent", "visible"}).exit_code, 0);
  EXPECT_EQ(read_bytes(folder + "/a_003.png"), read_bytes(folder + "/c_003.png"));
  EXPECT_NE(read_bytes(folder + "/a_003.png"), read_bytes(folder + "/a_005.png"));
  // A turned camera sees something else, but after whole turns the same.
  EXPECT_EQ(render({"-o", folder + "/d_###.png", "--turntable", "0.5"}).exit_code, 0);
  EXPECT_NE(read_bytes(folder + "/d_003.png"), read_bytes(folder + "/a_003.png"));

  const ProgramResult unnumbered = render({"-o", folder + "/a.png"});
  EXPECT_EQ(unnumbered.exit_code, 2);
  EXPECT_NE(unnumbered.err.find("a_#####.png"), std::string::npos) << unnumbered.err;
  EXPECT_EQ(render({"-o", folder + "/a_###.png"}).exit_code, 6);  // they exist
  EXPECT_EQ(meniscus({"render", file_, "-q", "-o", folder + "/z.png", "--turntable", "1"}).exit_code, 2);
}

TEST_F(Frames, NumbersByFrameColorEachOfThem) {
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
  // A frame without numbers fails, the others are made; a single picture is none of a run.
  const ProgramResult gap =
      meniscus({"render", file_, "-q", "--size", "64x48", "-o", (folder.path() / "gap_#.png").string(), "--frames",
                "0-2", "--color-by-file", run});
  EXPECT_EQ(gap.exit_code, 3);
  EXPECT_NE(gap.err.find("holds numbers of 2 frames, 0 to 1, but none of frame 2"), std::string::npos) << gap.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "gap_1.png"));
  const ProgramResult alone =
      meniscus({"render", file_, "-q", "-o", (folder.path() / "a.png").string(), "--color-by-file", run});
  EXPECT_EQ(alone.exit_code, 3);
  EXPECT_NE(alone.err.find("ask for a run of frames"), std::string::npos) << alone.err;
  // A frame that is shown again has the numbers of the trajectory's.
  picture("again_#.png", {"--frames", "2,3", "--repeat", "2", "--color-by-file", run});
  EXPECT_TRUE(bytes("again_2.png") == bytes("again_3.png"));
  picture("second_#.png", {"--frames", "1", "--color-by-file", run});
  EXPECT_TRUE(bytes("again_2.png") == bytes("second_1.png"));
}

// One scale for all frames, whatever is in the first.
TEST_F(Frames, WhatColorsMeanIsMeasuredOverTheRun) {
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
  const ProgramResult extent = meniscus({"render", file_, "-q", "-o", (folder.path() / "a_#.png").string(), "--frames",
                                         "all", "--extent", "visible", "--color", "radial"});
  EXPECT_EQ(extent.exit_code, 2);
  EXPECT_NE(extent.err.find("change from frame to frame"), std::string::npos) << extent.err;
}

TEST_F(Frames, ATurntableTakesEqualStepsAndShowsNoPlaceTwice) {
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

TEST_F(Frames, Film) {
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
  // A film with a hole is no film, and nothing stays behind.
  const std::string bad = folder_.file("bad.pdb", walk(5, 2));
  EXPECT_EQ(meniscus({"render", bad, "-q", "--size", "64x48", "--frames", "all", "-o", folder + "/d.mp4"}).exit_code,
            3);
  const std::vector<std::string> entries = folder_.entries();
  EXPECT_EQ(
      std::ranges::count_if(entries, [](const std::string& name) { return name.find("d.mp4") != std::string::npos; }),
      0);
}

// Decoded, each picture of a film is nearest to the one of its own frame, and there is one for each.
TEST_F(Frames, AFilmShowsEachFrameInItsPlace) {
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

TEST_F(Frames, ACurveGoesAlong) {
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
  // A share of the run has the same pictures; another column, none and another frame have others.
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
  refused({"--curve", folder_.file("short.csv", "frame,time,volume\n0,,1\n1,,2\n")}, 3, "has no row of frame 2");
  refused({"--curve", folder_.file("twice.csv", "frame,volume\n0,1\n0,2\n")}, 3, "twice.csv:3: frame 0 stands here a");
  refused({"--curve", folder_.file("word.csv", "frame,volume\n0,many\n")}, 3, "word.csv:2: volume 'many' is no number");
  refused({"--curve", folder_.file("none.csv", "a,b\n")}, 3, "none.csv:1: is no header with a column 'frame'");
  refused({"--curve-column", "volume"}, 2, "--curve");
  const ProgramResult one = meniscus({"render", file_, "-q", "-o", folder + "/one.png", "--curve", table});
  EXPECT_EQ(one.exit_code, 2);
  EXPECT_NE(one.err.find("--curve is for a run of frames"), std::string::npos) << one.err;
}

TEST_F(Frames, FilmWithoutFfmpegSaysSo) {
  const ProgramResult result =
      run_program("/usr/bin/env", {"PATH=/nowhere", MENISCUS_PROGRAM, "render", file_, "-q", "--size", "64x48",
                                   "--frames", "all", "-o", folder_.path().string() + "/a.mp4"});
  EXPECT_EQ(result.exit_code, 6);
  EXPECT_NE(result.err.find("need the program ffmpeg"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace meniscus::test
