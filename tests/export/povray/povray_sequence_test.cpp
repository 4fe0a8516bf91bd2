// SPDX-License-Identifier: BSD-3-Clause
// A run of frames in one POV-Ray scene: frames have their numbers, machines share them, and cameras move.
#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/export/povray/povray_render.h"
#include "tests/support/run_program.h"

namespace meniscus::testing {
namespace {

// Fifteen residues of ubiquitin in solution: ten models, which are the frames.
const std::vector<std::string> kMolecule{
    "/usr/share/freesasa/test-data/1d3z.pdb", "--select", "resi 1-15", "--device", "cpu", "--size", "120x90"};
const std::vector<int> kFrames{1, 3, 5};  // frames of --frames 1-5:2

using Words = std::vector<std::string>;

Words operator+(Words first, const Words& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

class PovraySequence : public ::testing::Test {
 protected:
  test::ProgramResult meniscus(const Words& command, const Words& options) const {
    return test::run_program(test::meniscus_program(), command + kMolecule + options);
  }
  std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
  test::ProgramResult export_run(const std::string& name, const Words& options) const {
    return meniscus({"export", "povray"}, Words{"-o", path(name).string()} + options);
  }
  /// Returns the pixels of a rendered picture.
  std::vector<glm::dvec3> picture(const std::string& scene, const std::string& name) const {
    return read_rgb(path(scene) / name);
  }
  PovrayRun render(const std::string& scene, const Words& options = {}) const {
    return run_povray(path(scene), Words{"surface.ini", "-A"} + options);
  }
  /// Saves a camera for all frames and returns its path.
  std::string camera() const {
    const std::string file = path("camera.json").string();
    EXPECT_EQ(meniscus({"render"}, {"-o", path("still.png").string(), "--save-camera", file, "--force"}).exit_code, 0);
    return file;
  }

  test::TemporaryFolder folder_;
};

double share_of_other_pixels(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  std::size_t other = a.size() == b.size() ? 0 : a.size();
  for (std::size_t n = 0; n < std::min(a.size(), b.size()); ++n) other += a[n] != b[n];
  return static_cast<double>(other) / static_cast<double>(a.size());
}

TEST_F(PovraySequence, EachFrameIsThatOfItsOwnExport) {
  const std::string shot = camera();
  ASSERT_EQ(export_run("run", {"--frames", "1-5:2", "--camera", shot}).exit_code, 0);
  ASSERT_EQ(render("run", {"+SF1", "+EF1"}).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(path("run") / "surface_00003.png"));
  for (const char* const frame : {"3", "5"})
    ASSERT_EQ(render("run", {fmt::format("+SF{}", frame), fmt::format("+EF{}", frame)}).exit_code, 0);
  std::vector<std::vector<glm::dvec3>> alone;
  for (const int frame : kFrames) {
    const std::string name = fmt::format("alone{}", frame);
    ASSERT_EQ(export_run(name, {"--model", fmt::format("{}", frame + 1), "--camera", shot}).exit_code, 0);
    ASSERT_EQ(render(name).exit_code, 0);
    alone.push_back(picture(name, "surface.png"));
  }
  for (std::size_t place = 0; place < kFrames.size(); ++place) {
    const auto shown = picture("run", fmt::format("surface_{:05}.png", kFrames[place]));
    for (std::size_t other = 0; other < kFrames.size(); ++other) {
      const double differs = share_of_other_pixels(shown, alone[other]);
      if (other == place)
        EXPECT_EQ(differs, 0.0) << "frame " << kFrames[place];
      else
        EXPECT_GT(differs, 0.05) << "frame " << kFrames[place];
    }
  }
}

TEST_F(PovraySequence, SharesAreTheSameBytesAsOneRun) {
  const Words options{"--frames", "1-5:2", "--turntable", "0.25"};
  ASSERT_EQ(export_run("whole", options).exit_code, 0);
  ASSERT_EQ(export_run("shares", options + Words{"--only", "5"}).exit_code, 0);
  const test::ProgramResult second = export_run("shares", options + Words{"--only", "1,3"});
  ASSERT_EQ(second.exit_code, 0) << second.err;
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(path("whole"))) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(test::read_bytes(entry.path()), test::read_bytes(path("shares") / name)) << name;
    ++files;
  }
  EXPECT_EQ(files, 6 + kFrames.size());
  // Files of another run in the folder are not overwritten.
  const test::ProgramResult other = export_run("shares", {"--frames", "0-4:2"});
  EXPECT_EQ(other.exit_code, 6) << other.err;
}

TEST_F(PovraySequence, MissingAndForeignFramesAreNamedErrors) {
  ASSERT_EQ(export_run("run", {"--frames", "1-5:2", "--only", "1,5"}).exit_code, 0);
  EXPECT_EQ(render("run", {"+SF5", "+EF5"}).exit_code, 0);
  const PovrayRun missing = render("run", {"+SF3", "+EF3"});
  EXPECT_NE(missing.exit_code, 0);
  EXPECT_NE(missing.log.find("there is no surface_geometry_00003.inc"), std::string::npos) << missing.log;
  EXPECT_FALSE(std::filesystem::exists(path("run") / "surface_00003.png"));
  // The other run has the same atoms, but its numbers of colours mean other colours.
  ASSERT_EQ(export_run("other", {"--frames", "1-5:2", "--color", "residue", "--only", "3"}).exit_code, 0);
  std::filesystem::copy(path("other") / "surface_geometry_00003.inc", path("run"));
  const PovrayRun foreign = render("run", {"+SF3", "+EF3"});
  EXPECT_NE(foreign.exit_code, 0);
  EXPECT_NE(foreign.log.find("other colours"), std::string::npos) << foreign.log;
  const PovrayRun beyond = run_povray(path("run"), {"surface.pov", "+W12", "+H9", "Declare=Meniscus_Frame=4"});
  EXPECT_NE(beyond.exit_code, 0);
  EXPECT_NE(beyond.log.find("is no frame 4 in this run of 3 frames"), std::string::npos) << beyond.log;
}

TEST_F(PovraySequence, TheCameraMovesUnlessTheUserHasOne) {
  const std::string shot = camera();
  ASSERT_EQ(export_run("turning", {"--frames", "1,2", "--camera", shot, "--turntable", "0.5"}).exit_code, 0);
  ASSERT_EQ(export_run("still", {"--frames", "1,2", "--camera", shot}).exit_code, 0);
  ASSERT_EQ(render("turning").exit_code, 0);
  ASSERT_EQ(render("still").exit_code, 0);
  EXPECT_EQ(share_of_other_pixels(picture("turning", "surface_00001.png"), picture("still", "surface_00001.png")), 0.0);
  EXPECT_GT(share_of_other_pixels(picture("turning", "surface_00002.png"), picture("still", "surface_00002.png")), 0.2);
  const std::string own =
      "#version 3.7;\n#declare Meniscus_Custom_Camera = 1;\n#declare Meniscus_Custom_Lights = 1;\n"
      "camera { location <0,0,60> look_at 0 angle 30 }\nlight_source { <0,0,100> rgb 1 }\n#include \"surface.pov\"\n";
  for (const char* const scene : {"turning", "still"}) {
    write_text(path(scene) / "own.pov", own);
    const PovrayRun run =
        run_povray(path(scene), {"+Iown.pov", "+Oown.png", "+W120", "+H90", "+KFI1", "+KFF2", "+SF2"});
    ASSERT_EQ(run.exit_code, 0) << run.log;
  }
  EXPECT_EQ(share_of_other_pixels(picture("turning", "own2.png"), picture("still", "own2.png")), 0.0);
}

// POV-Ray counts even steps itself; it finds other frames by their places in the run.
TEST_F(PovraySequence, PicturesHaveNumbersOfTheTrajectoryOrPlacesInTheRun) {
  for (const auto& [frames, numbers] :
       {std::pair{"4", Words{"4"}}, std::pair{"0-2", Words{"0", "1", "2"}}, std::pair{"1-5:2", Words{"1", "3", "5"}},
        std::pair{"4,2", Words{"4", "2"}}, std::pair{"0,1,3", Words{"0", "1", "3"}}}) {
    SCOPED_TRACE(frames);
    const test::ProgramResult exported = export_run(frames, {"--frames", frames, "--size", "24x18"});
    ASSERT_EQ(exported.exit_code, 0) << exported.err;
    const test::ProgramResult run = test::run_program("/bin/sh", {"-c", exported.out});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const bool is_even = frames != std::string("4,2") && frames != std::string("0,1,3");
    EXPECT_EQ(exported.out.find("[film]") == std::string::npos, is_even) << exported.out;
    if (is_even) {
      ASSERT_EQ(render(frames, {"surface.ini[film]"}).exit_code, 0);
    }
    std::size_t pictures = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path(frames)))
      pictures += entry.path().extension() == ".png";
    EXPECT_EQ(pictures, (is_even ? 2 : 1) * numbers.size());
    for (std::size_t place = 0; place < numbers.size(); ++place) {
      const std::string& number = numbers[place];
      if (!is_even) {
        ASSERT_EQ(render(frames, {"+SF" + number, "+EF" + number, "+A0.05"}).exit_code, 0);
      }
      EXPECT_EQ(share_of_other_pixels(picture(frames, "surface_0000" + number + ".png"),
                                      picture(frames, fmt::format("surface_film_{:05}.png", place + 1))),
                0.0)
          << number;
    }
  }
  const PovrayRun beyond = run_povray(path("4,2"), {"surface.ini[film]", "+SF3", "+EF3"});
  EXPECT_NE(beyond.exit_code, 0);
  EXPECT_NE(beyond.log.find("is no place 3 in this run of 2 frames"), std::string::npos) << beyond.log;
}

// The include of colours that change must belong to the geometry's frame and run.
TEST_F(PovraySequence, ColorsThatChangeBelongToTheirFrame) {
  ASSERT_EQ(export_run("run", {"--frames", "1-5:2", "--color", "radial"}).exit_code, 0);
  EXPECT_EQ(render("run", {"+SF3", "+EF3"}).exit_code, 0);
  EXPECT_EQ(render("run", {"surface.ini[group]", "+SF5", "+EF5"}).exit_code, 0);
  const auto refused = [&](const std::string& what) {
    const PovrayRun foreign = render("run", {"+SF3", "+EF3"});
    EXPECT_NE(foreign.exit_code, 0) << what;
    EXPECT_NE(foreign.log.find("other colours"), std::string::npos) << what << ": " << foreign.log;
  };
  const auto replace = [&](const std::filesystem::path& from, const std::string& name) {
    std::filesystem::copy(from, path("run") / name, std::filesystem::copy_options::overwrite_existing);
  };
  replace(path("run") / "surface_colors_00001.inc", "surface_colors_00003.inc");
  refused("colours of another frame");
  ASSERT_EQ(export_run("other", {"--frames", "3-9", "--color", "radial"}).exit_code, 0);
  for (const std::string name : {"surface_colors_00003.inc", "surface_geometry_00003.inc"})
    replace(path("other") / name, name);
  refused("a frame of another run");
}

TEST_F(PovraySequence, TheCameraIsSaved) {
  const std::string first = path("first.json").string(), again = path("again.json").string();
  ASSERT_EQ(export_run("run", {"--frames", "1-5:2", "--turn", "y30", "--save-camera", first}).exit_code, 0);
  ASSERT_EQ(export_run("one", {"--camera", first, "--save-camera", again}).exit_code, 0);
  EXPECT_EQ(test::read_bytes(first), test::read_bytes(again));
  const auto line = [&](const std::string& scene, const std::string& name) {
    const std::string text = test::read_bytes(path(scene) / "surface.pov");
    const std::size_t begin = text.find("#declare " + name);
    return begin == std::string::npos ? scene : text.substr(begin, text.find('\n', begin) - begin);
  };
  for (const std::string name : {"Meniscus_Right", "Meniscus_Up", "Meniscus_Forward", "Meniscus_Picture_Height"})
    EXPECT_EQ(line("run", name), line("one", name));
  EXPECT_EQ(export_run("two", {"--save-camera", again}).exit_code, 6);  // The camera's file exists.
  EXPECT_FALSE(std::filesystem::exists(path("two")));
  const std::string moving = path("moving.json").string();
  ASSERT_EQ(export_run("turning", {"--frames", "3,1", "--turntable", "1", "--save-camera", moving}).exit_code, 0);
  ASSERT_EQ(export_run("along", {"--frames", "3,1", "--camera-path", moving}).exit_code, 0);
  EXPECT_EQ(test::read_bytes(path("turning") / "surface.pov"), test::read_bytes(path("along") / "surface.pov"));
}

}  // namespace
}  // namespace meniscus::testing
