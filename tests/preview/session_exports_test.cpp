// SPDX-License-Identifier: BSD-3-Clause
// Exports of a session run while pictures are drawn, can be cancelled, and have names with the right endings.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/structure/formats/read_structure.h"
#include "tests/preview/session_case.h"
#include "tests/preview/two_models.h"

namespace meniscus::test {
namespace {

class SessionExports : public SessionCase {
 protected:
  SessionExports() {
    SessionContext context;
    context.writes_scenes = true;
    begin(read_structure(folder_.file("two.pdb", kTwoModels)), context);
  }
};

// Even "force" never replaces a file of another kind.
TEST_F(SessionExports, EndWhatTheirFormatEndsIn) {
  const std::map<std::string, std::vector<std::string>> allowed{
      {"png", {"p.png", "p.tif", "p.exr"}}, {"povray", {"p"}},   {"blender", {"p.mns"}}, {"camera", {"p.json"}},
      {"camera_path", {"p.json"}},          {"save", {"p.json"}}};
  const std::vector<std::string> names{"p",        "p.png",   "p.tif",     "p.exr",     "p.mns",      "p.json", "p.pdb",
                                       "p.py",     "p.jsonl", "p.mns.bak", "p.png.mns", "p.json.png", "p.sh",   "png",
                                       "view.ini", "mns",     "notes.txt", "p.JSON",    "p.mnss"};
  apply(R"({"command":"key"})");  // a path of the camera needs a key
  for (const auto& [format, good] : allowed) {
    for (const std::string& name : names) {
      SCOPED_TRACE(::testing::Message() << format << " " << name);
      const auto ends_well = [&](const std::string& one) {
        const std::string ending = std::filesystem::path(one).extension();
        return !ending.empty() && name.ends_with(ending);
      };
      const bool fits = format == "povray" ? name.find('.') == std::string::npos : std::ranges::any_of(good, ends_well);
      if (fits && name[0] != 'p') continue;
      const std::string file = folder_.file(name, "precious");
      Json command{{"command", format == "save" ? "save" : "export"}, {"path", name}, {"force", true}};
      if (format != "save") command["format"] = format;
      if (format == "png") command.update({{"width", 20}, {"height", 20}, {"samples", 1}});
      if (format == "povray" && fits) std::filesystem::remove(file);  // a scene is a folder, which replaces no file
      const Json reply = session_->apply(command);
      EXPECT_EQ(reply["ok"], fits) << reply;
      if (!fits) {
        EXPECT_EQ(read_bytes(file), "precious");
        EXPECT_NE(reply.value("error", "").find(name), std::string::npos) << reply;
      } else if (format != "povray") {
        EXPECT_NE(read_bytes(file), "precious");
      }
      std::filesystem::remove_all(file);
    }
  }
  // A folder with other files keeps them, and a file is not a folder.
  std::filesystem::create_directory(folder_.path() / "work");
  const std::string mine = folder_.file("work/mine.txt", "precious");
  expect_ok(R"({"command":"export","format":"povray","path":"work","force":true})");
  EXPECT_EQ(read_bytes(mine), "precious");
  const std::string plain = folder_.file("plain", "precious");
  EXPECT_FALSE(apply(R"({"command":"export","format":"povray","path":"plain","force":true})")["ok"]);
  EXPECT_EQ(read_bytes(plain), "precious");
}

// A figure in a file or in a log is not lost with the session.
TEST_F(SessionExports, TellWhatIsNotSaved) {
  const auto unsaved = [&] { return apply(R"({"command":"state"})")["unsaved"].get<bool>(); };
  EXPECT_FALSE(unsaved());
  expect_ok(R"({"command":"orbit","dx":0.1,"dy":0})");
  EXPECT_FALSE(unsaved()) << "a look around";
  const std::string change = R"({"command":"set","key":"surface.probe","value":1.5})";
  expect_ok(change);
  EXPECT_TRUE(unsaved());
  expect_ok(R"({"command":"undo"})");
  EXPECT_FALSE(unsaved());
  expect_ok(R"({"command":"redo"})");
  EXPECT_TRUE(unsaved());
  expect_ok(R"({"command":"save","path":"fig.json"})");
  EXPECT_FALSE(unsaved());
  expect_ok(R"({"command":"undo"})");
  EXPECT_TRUE(unsaved()) << "of which there is no file";
  expect_ok(R"({"command":"export","format":"povray","path":"scene"})");
  EXPECT_TRUE(unsaved()) << "that file cannot be opened again";
  expect_ok(R"({"command":"export","format":"png","path":"p.png","width":20,"height":20})");
  EXPECT_FALSE(unsaved()) << "a picture carries its scene";
  expect_ok(change);
  EXPECT_TRUE(unsaved());
  session_->record([](const Json&) {});
  EXPECT_FALSE(unsaved()) << "the log has it";
}

TEST_F(SessionExports, AnExportIsMadeBesideThePicturesAndCanBeCancelled) {
  const std::string large = R"({"command":"export","format":"png","path":"large.png","width":2000,"height":2000,)"
                            R"("samples":1024,"wait":false})";
  Json recorded;
  session_->record([&](const Json& command) { recorded.push_back(command); });
  const Json begun = apply(large);
  ASSERT_TRUE(begun["ok"]) << begun;
  EXPECT_TRUE(begun["running"]);
  EXPECT_FALSE(recorded.at(0).contains("wait")) << "whoever carries it out again waits";
  expect_ok(R"({"command":"orbit","dx":0.1,"dy":0})");
  EXPECT_TRUE(session_->render(Quality::full)) << "while it is written";
  EXPECT_NE(apply(large)["error"].get<std::string>().find("is being written"), std::string::npos);
  const auto told = [&] { return apply(R"({"command":"export_state"})"); };
  const auto wait_until = [&](const auto& done) {
    for (int n = 0; n < 1200 && !done(told()); ++n) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return told();
  };
  const Json casting =
      wait_until([](const Json& now) { return now.value("stage", "") == "picture" || !now["running"]; });
  ASSERT_TRUE(casting["running"]) << casting;
  EXPECT_GE(casting["share"], 0.0);
  EXPECT_LT(casting["share"], 1.0);
  expect_ok(R"({"command":"cancel_export"})");
  const Json ended = wait_until([](const Json& now) { return now["running"] == false; });
  EXPECT_NE(ended.value("error", std::string()).find("cancelled"), std::string::npos) << ended;
  EXPECT_FALSE(apply(R"({"command":"cancel_export"})")["ok"]);
  EXPECT_EQ(folder_.entries(), std::vector<std::string>{"two.pdb"});
  // The next export finishes, with the view at the time of its request.
  expect_ok(R"({"command":"export","format":"png","path":"small.png","wait":false})");
  const Json done = wait_until([](const Json& now) { return now["running"] == false; });
  EXPECT_NE(done.value("path", std::string()).find("small.png"), std::string::npos);
  EXPECT_FALSE(done.contains("error")) << done;
  EXPECT_EQ(folder_.entries(), (std::vector<std::string>{"small.png", "two.pdb"}));
}

// Browsers may download these files, and no others.
TEST_F(SessionExports, ListWhatTheyHaveWritten) {
  folder_.file("foreign.png", "precious");
  const auto names = [&] {
    std::vector<std::string> found;
    for (const std::filesystem::path& path : session_->written_paths()) found.push_back(path.filename());
    return found;
  };
  EXPECT_TRUE(names().empty());
  expect_ok(R"({"command":"save","path":"a.json"})");
  expect_ok(R"({"command":"export","format":"camera","path":"b.json"})");
  expect_ok(R"({"command":"export","format":"png","path":"c.png","width":20,"height":20})");
  EXPECT_FALSE(apply(R"({"command":"export","format":"png","path":"foreign.png","width":20,"height":20})")["ok"]);
  std::filesystem::create_directory(folder_.path() / "scene");
  folder_.file("scene/mine.txt", "precious");
  expect_ok(R"({"command":"export","format":"povray","path":"scene","archive":true,"force":true})");
  EXPECT_EQ(names(), (std::vector<std::string>{"a.json", "b.json", "c.png", "scene", "scene.zip"}));
  const Json written = apply(R"({"command":"export_state"})")["written"];
  EXPECT_EQ(written[3]["folder"], true);
  EXPECT_EQ(written[4]["folder"], false);
  EXPECT_EQ(written[4]["path"], (folder_.path() / "scene.zip").string());
  const std::string archive = read_bytes(folder_.path() / "scene.zip");
  EXPECT_TRUE(archive.starts_with("PK"));
  EXPECT_NE(archive.find("scene/surface.pov"), std::string::npos);
  EXPECT_EQ(archive.find("mine.txt"), std::string::npos) << "which the session did not write";
}

// `meniscus film` makes a film of the strip from the scenes that `save` writes.
TEST_F(SessionExports, AFilmOfTheStripIsAStoryboard) {
  FilmOrder ordered;
  SessionContext context;
  context.writes_scenes = true;
  context.make_film = [&](const FilmOrder& order, const ExportTarget&, const ExportWatch&) { ordered = order; };
  ReadOptions reading;
  reading.model.all = true;
  begin(read_structure(folder_.file("two.pdb", kTwoModels), reading), context);
  const auto film = [&](const std::string& more) {
    return apply(R"({"command":"export","format":"film","path":"f.mp4","width":81,"height":60)" + more + "}");
  };
  EXPECT_FALSE(film(R"(,"of":"strip")")["ok"]);
  ASSERT_TRUE(film("")["ok"]);
  EXPECT_EQ(ordered.words[1], "render") << "of frames, where there are two models";
  expect_ok(R"({"command":"keep_scene"})");
  expect_ok(R"({"command":"set","key":"surface.probe","value":2})");
  expect_ok(R"({"command":"frame","index":1})");
  expect_ok(R"({"command":"keep_scene"})");
  expect_ok(R"({"command":"time_scene","index":0,"transition":0.5})");
  ASSERT_TRUE(film("")["ok"]);
  EXPECT_EQ(ordered.words[1], "film");
  expect_ok(R"({"command":"save","path":"story.json","strip":true,"width":81,"height":60})");
  EXPECT_EQ(read_bytes(folder_.path() / "story.json"), ordered.storyboard);
  const Json story = Json::parse(ordered.storyboard);
  EXPECT_EQ(story["hold"], Json::parse("[2.0,2.0]"));
  EXPECT_EQ(story["transition"], Json::parse("[0.5]"));
  expect_ok(R"({"command":"save","path":"two.json","width":80,"height":60})");
  EXPECT_EQ(story["scenes"][1], Json::parse(read_bytes(folder_.path() / "two.json")));
  EXPECT_EQ(story["scenes"][1]["molecule"]["model"], 2);
  ASSERT_TRUE(film(R"(,"of":"turntable","seconds":2)")["ok"]);
  EXPECT_EQ(ordered.words[1], "render");
  EXPECT_NE(std::ranges::find(ordered.words, "50"), ordered.words.end()) << "pictures in two seconds";
}

}  // namespace
}  // namespace meniscus::test
