// SPDX-License-Identifier: BSD-3-Clause
// Runs of frames of users: the choice of frames, their preparation, failures and their reports.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/cli/walking_atoms.h"

namespace meniscus::test {
namespace {

using Json = nlohmann::json;

std::vector<Json> lines_of(const std::string& text) {
  std::vector<Json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with('{')) lines.push_back(Json::parse(line));
  return lines;
}

class Frames : public WalkingAtoms {
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
}

// Frames are chosen first, then repeated: each frame of the run as often, with its number in tables.
TEST_F(Frames, AreRepeatedOnceTheyAreChosen) {
  EXPECT_EQ(numbers({"--repeat", "3", "--frames", "0-5"}).size(), 18u);
  EXPECT_EQ(numbers({"--repeat", "2", "--frames", "3-4"}), (std::vector<int>{3, 3, 4, 4}));
  EXPECT_EQ(numbers({"--repeat", "2", "--begin", "5", "--stride", "2"}), (std::vector<int>{5, 5, 7, 7}));
  EXPECT_EQ(numbers({"--repeat", "2", "--frames", "3-4", "--only", "7-8"}), (std::vector<int>{3, 4}));
  expect_error({"--repeat", "2", "--frames", "3-4", "--only", "4"}, 2, "frame 4 is not in the run");
  const std::vector<Json> slow = surface({"--repeat", "2", "--frames", "2-3", "--reference", "7", "--center", "all"});
  const std::vector<Json> once = surface({"--frames", "2-3", "--reference", "7", "--center", "all"});
  for (int n = 0; n < 4; ++n) EXPECT_EQ(slow[n]["area"], once[n / 2]["area"]) << n;
  const std::string folder = folder_.path().string();
  const ProgramResult turning = meniscus({"render", file_, "-q", "--size", "32x24", "--frames", "1", "--repeat", "3",
                                          "--turntable", "0.1", "-o", folder + "/turn_#.png"});
  EXPECT_EQ(turning.exit_code, 0) << turning.err;
  for (const int n : {3, 4, 5}) EXPECT_TRUE(std::filesystem::exists(fmt::format("{}/turn_{}.png", folder, n))) << n;
}

// Files round times: a frame at a bound, except for a small part of the step, belongs to the run.
TEST_F(Frames, OfABoundInTimeBelongToTheRun) {
  std::string text;
  for (const char* time : {"0.00000", "9.99999", "20.00001", "30.00000"})
    text += fmt::format(
        "two t= {}\n2\n{:>5}{:<5}{:>5}{:>5}{:>8.3f}{:>8.3f}{:>8.3f}\n{:>5}{:<5}{:>5}{:>5}{:>8.3f}{:>8.3f}"
        "{:>8.3f}\n2 2 2\n",
        time, 1, "ALA", "N", 1, 0.0, 0.0, 0.0, 1, "ALA", "CA", 2, 0.146, 0.0, 0.0);
  file_ = folder_.file("times.gro", text);
  EXPECT_EQ(numbers({"--begin", "10ps", "--end", "20ps"}), (std::vector<int>{1, 2}));
  expect_error({"--begin", "10.02ps", "--end", "19.98ps"}, 2, "no frame is left");
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

/// Returns an alanine in boxes of 2 nm (the second one sheared), moved by `shift` nm and cut at the faces.
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
        if (frame == 1) x -= 0.5;  // the vector b of the sheared box is (0.5, 2, 0)
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
  expect_error({"--frames", "all", "--superpose", "name CA"}, 2, "selects 1 of 4 atoms; at least 3 are needed");
  expect_error({"--frames", "all", "--model", "2"}, 2, "leave --model out");
  expect_error({"--frames", "all", "--center", "all", "--reference", "8"}, 2, "0 to 7");
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

/// Returns the paths and contents of everything below a folder.
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

// GL belongs to one thread, so frames that it verifies are made one after another.
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
    EXPECT_EQ(lines_of(result.err).front().value("at_once", 0), std::stoi(jobs)) << result.err;
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

}  // namespace
}  // namespace meniscus::test
