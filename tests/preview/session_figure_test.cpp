// SPDX-License-Identifier: BSD-3-Clause
// Commands that change a figure, their errors, and undo and redo of them.
#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/preview/command_json.h"
#include "tests/preview/session_case.h"

namespace meniscus::test {
namespace {

class FigureSession : public PeptideSession {
 protected:
  using PeptideSession::PeptideSession;

  /// Returns the state without the values that every command changes.
  Json state() {
    Json state = SessionCase::state();
    for (const char* key : {"revision", "undo", "redo", "drawn_by"}) state.erase(key);
    return state;
  }
};

constexpr const char* kEdits[] = {
    R"({"command":"add","key":"figure.sticks","value":"ligand"})",
    R"({"command":"add","key":"figure.spheres","value":"resn HOH"})",
    R"({"command":"set","key":"figure.sticks","index":0,"value":null})",
    R"({"command":"add","key":"figure.object","value":{"selection":"ligand","color":"red"}})",
    R"({"command":"add","key":"figure.object","value":{"representation":"spheres","selection":"resn HOH","color":"#00ff00"}})",
    R"({"command":"set","key":"surface.shown","value":false})",
    R"({"command":"set","key":"figure.object","index":0,"value":{"selection":"ligand","color":"blue","opacity":"0.6","clip":"x<6.5"}})",
    R"({"command":"set","key":"surface.shown","value":true})",
    R"({"command":"set","key":"figure.object","index":1,"value":null})",
    R"({"command":"set","key":"surface.show","value":"within 5 of ligand"})",
    R"({"command":"set","key":"surface.show","value":null})",
    R"({"command":"set","key":"surface.color","value":"bfactor"})",
    R"({"command":"set","key":"surface.map","value":"magma"})",
    R"({"command":"set","key":"surface.color_range","value":"10:20"})",
    R"({"command":"add","key":"surface.color","value":"name CA=red"})",
    R"({"command":"add","key":"surface.opacity","value":"name O=0.5"})",
    R"({"command":"set","key":"surface.film_opacity","value":true})",
    R"({"command":"add","key":"surface.clip","value":"x<1"})",
    R"({"command":"set","key":"surface.cap_color","value":"#00ff00"})",
    R"({"command":"orbit","dx":0.0,"dy":0.1})",
    R"({"command":"set","key":"surface.cap_hatching","value":0.5})",
    R"({"command":"take_away","selection":"name N"})",
    R"({"command":"set","key":"look.preset","value":"flat"})",
    R"({"command":"set","key":"image.background","value":"#336699"})",
    R"({"command":"set","key":"surface.patches","value":"name CA CB"})",
    R"({"command":"set","key":"surface.min_patch","value":25})",
    R"({"command":"set","key":"look.patch_lines","value":6})",
    R"({"command":"set","key":"look.patch_line_color","value":"yellow"})",
    R"({"command":"set","key":"legend.title","value":"B"})",
    R"({"command":"set","key":"legend.shown","value":true})",
    R"({"command":"resize","width":400,"height":300})",
    R"({"command":"set","key":"surface.probe","value":2})",
    R"({"command":"set","key":"surface.kind","value":"sas"})",
    R"({"command":"set","key":"surface.probe","value":1})",
    R"({"command":"set","key":"surface.kind","value":"vdw"})",
    R"({"command":"reset_view"})",
    R"({"command":"orbit","dx":0.1,"dy":0.1})",
    R"({"command":"set","key":"surface.color","value":"kind"})",
};

TEST_F(FigureSession, EveryStepChangesThePictureAndUndoBringsItBack) {
  std::vector<Json> states{state()};
  std::vector<std::vector<std::uint8_t>> pictures{picture()};
  for (const char* edit : kEdits) {
    expect_ok(edit);
    if (Json::parse(edit)["command"] == "resize") {
      states.back() = state();
      pictures.back() = picture();  // the page's size is not undone
      continue;
    }
    states.push_back(state());
    pictures.push_back(picture());
    if (Json::parse(edit)["command"] != "reset_view") {
      EXPECT_NE(states.back(), states[states.size() - 2]) << edit;
    }
  }
  for (std::size_t n = states.size() - 1; n-- > 0;) {
    expect_ok(R"({"command":"undo"})");
    Json expected = states[n];
    expected["width"] = 400;  // the size of the page at that time
    expected["height"] = 300;
    Json now = state();
    for (Json* json : {&expected, &now}) {
      json->erase("camera");
      for (const char* kind : {"silhouettes", "outer_lines", "inner_lines", "part_lines", "patch_lines"})
        (*json)["values"].erase(std::string("look.") + kind);
    }
    now.erase("legend_fault");
    expected.erase("legend_fault");
    EXPECT_EQ(now, expected) << n;
  }
  EXPECT_FALSE(apply(R"({"command":"undo"})")["ok"]);
  for (std::size_t n = 1; n < states.size(); ++n) expect_ok(R"({"command":"redo"})");
  EXPECT_EQ(state(), states.back());
  EXPECT_EQ(picture(), pictures.back());
  EXPECT_FALSE(apply(R"({"command":"redo"})")["ok"]);
}

TEST_F(FigureSession, ADragIsOneStepUntilItIsEnded) {
  const Json before = state();
  for (int n = 0; n < 5; ++n) expect_ok(R"({"command":"orbit","dx":0.02,"dy":0.01})");
  const Json first = state();
  expect_ok(R"({"command":"end_step"})");
  expect_ok(R"({"command":"orbit","dx":0.02,"dy":0.01})");
  EXPECT_EQ(apply(R"({"command":"state"})")["undo"], 2);
  expect_ok(R"({"command":"undo"})");
  EXPECT_EQ(state(), first);
  expect_ok(R"({"command":"undo"})");
  EXPECT_EQ(state(), before);
  // A new command clears the redo history.
  expect_ok(R"({"command":"set","key":"surface.probe","value":1})");
  expect_ok(R"({"command":"set","key":"surface.probe","value":1.1})");
  const Json after = apply(R"({"command":"state"})");
  EXPECT_EQ(after["redo"], 0);
  EXPECT_EQ(after["undo"], 1) << "a slider moves in one step";
}

TEST_F(FigureSession, WhatIsRefusedEndsNoStep) {
  expect_ok(R"({"command":"orbit","dx":0.02,"dy":0.01})");
  EXPECT_FALSE(apply(R"({"command":"redo"})")["ok"]);
  expect_ok(R"({"command":"orbit","dx":0.02,"dy":0.01})");
  EXPECT_EQ(apply(R"({"command":"state"})")["undo"], 1);
}

TEST_F(FigureSession, WhatIsRefusedChangesNothing) {
  expect_ok(R"({"command":"add","key":"surface.clip","value":"x<1"})");
  const Json before = apply(R"({"command":"state"})");
  const std::vector<std::pair<const char*, const char*>> kRefused{
      {R"({"command":"add","key":"figure.sticks","value":"chain Q"})", "chain Q"},
      {R"({"command":"add","key":"figure.sticks","value":"chain ("})", "add: figure.sticks"},
      {R"({"command":"add","key":"figure.lines","value":"all"})", "add: \"key\" is 'figure.lines'"},
      {R"({"command":"add","key":"surface.color","value":"all=rot"})", "rot"},
      {R"({"command":"add","key":"surface.color","value":"all=file"})", "--color-by-file"},
      {R"({"command":"add","key":"surface.opacity","value":1.5})", "not an opacity from 0"},
      {R"({"command":"set","key":"surface.opacity","index":0,"value":1})", "index"},
      {R"({"command":"add","key":"surface.clip","value":"x=1"})", "there is no < or >"},
      {R"({"command":"set","key":"surface.clip","index":1,"value":"x<2"})", "from 0 to 0"},
      {R"({"command":"set","key":"surface.cap_color","value":"greenish"})", "cap_color: 'greenish'"},
      {R"({"command":"set","key":"surface.cap_hatching","value":-1})", "cap_hatching: '-1'"},
      {R"({"command":"set","key":"surface.cap_hatching","value":[1]})", "cap_hatching: '[1]'"},
      {R"({"command":"set","key":"surface.film_opacity","value":"perhaps"})", "neither true nor false"},
      {R"({"command":"set","key":"surface.shown","value":7})", "neither true nor false"},
      {R"({"command":"set","key":"surface.prob","value":2})", "did you mean surface.probe?"},
      {R"({"command":"set","key":"surface.cap_hatching"})", "value"},
      {R"({"command":"set","key":"surface.color","index":1,"value":null})", "from 0 to 0"},
      {R"({"command":"set","key":"surface.clip","index":1,"value":null})", "from 0 to 0"},
      {R"({"command":"set","key":"surface.opacity","index":0,"value":null})", "the list is still empty"},
      {R"({"command":"set","key":"surface.probe","index":0,"value":1})", "one value and no list"},
      {R"({"command":"add","key":"surface.clip","value":null})", "null is not a value to add"},
      {R"({"command":"add","key":"surface.clip","value":["x<1","x>0"]})", "give one entry"},
      {R"({"command":"take_away","selection":"all"})", "nothing would be shown"},
      {R"({"command":"set","key":"surface.show","value":"resid 9"})", "nothing would be left"},
      {R"({"command":"set","key":"look.preset","value":"loud"})", "publication"},
      {R"({"command":"set","key":"legend.place","value":"left"})", "one of auto, right, below"},
      {R"({"command":"set","key":"surface.color_range","value":"9:1"})", "lo:hi"},
      {R"({"command":"set","key":"surface.color_range","value":"1:9"})", "colours by a number"},
      {R"({"command":"set","key":"shapes.stick_radius","value":0})", "stick_radius: '0'"},
      {R"({"command":"set","key":"surface.kind","value":"ms"})", "one of ses, sas, vdw"},
      {R"({"command":"zoom","factor":2})", "is not a command"},
      {R"({"command":"paint","selection":"all","color":"red"})", "use set with the key surface.color"},
  };
  for (const auto& [command, part] : kRefused) {
    const Json reply = apply(command);
    EXPECT_FALSE(reply["ok"]) << command;
    EXPECT_NE(reply.value("error", "").find(part), std::string::npos) << command << " -> " << reply;
    EXPECT_EQ(apply(R"({"command":"state"})"), before) << command;
  }
  expect_ok(R"({"command":"set","key":"surface.color","value":"#ff0000"})");
  EXPECT_FALSE(apply(R"({"command":"set","key":"legend.shown","value":true})")["ok"]);
}

TEST_F(FigureSession, AtomsBesideTheSurfaceAreThoseOfTheWholeFile) {
  EXPECT_FALSE(apply(R"({"command":"zoom_to","selection":"resn LIG"})")["ok"]) << "it is not shown";
  const auto alone = picture();
  expect_ok(R"({"command":"add","key":"figure.balls","value":"resn LIG"})");
  EXPECT_EQ(apply(R"({"command":"zoom_to","selection":"resn LIG"})")["atoms"], 2);
  EXPECT_NE(picture(), alone);
  const Json pick = apply(R"({"command":"pick","x":40,"y":30})");
  ASSERT_TRUE(pick["hit"]);
  EXPECT_EQ(pick["residue"], "LIG");
  EXPECT_EQ(pick["kind"], "shape");
  EXPECT_TRUE(pick["exposed_area"].is_null());
  expect_ok(R"({"command":"set","key":"figure.balls","value":null})");
  expect_ok(R"({"command":"reset_view"})");
  EXPECT_EQ(picture(), alone);
}

TEST_F(FigureSession, TheFirstViewComesBack) {
  const Json first = state()["camera"];
  expect_ok(R"({"command":"orbit","dx":0.3,"dy":0})");
  const Json side = state()["camera"];
  expect_ok(R"({"command":"reset_view"})");
  EXPECT_EQ(state()["camera"], first);
  expect_ok(R"({"command":"undo"})");
  EXPECT_EQ(state()["camera"], side);
}

TEST_F(FigureSession, ACameraThatWasGivenIsWhatResetReturnsTo) {
  Camera given;
  given.position = {1, 2, 30};
  given.target = {1, 2, 0};
  PreviewState view;
  view.size = {80, 60};
  PreviewSession session(make_cpu_preview_renderer(), session_->structure(), view, given, folder_.path());
  session.apply({{"command", "orbit"}, {"dx", 0.3}, {"dy", 0.0}});
  session.apply({{"command", "reset_view"}});
  EXPECT_EQ(session.state().camera.position, given.position);
  EXPECT_EQ(session.state().camera.target, given.target);
}

TEST_F(FigureSession, TheLegendStandsBesideTheMolecule) {
  expect_ok(R"({"command":"resize","width":400,"height":300})");
  expect_ok(R"({"command":"set","key":"surface.color","value":"element"})");
  const auto without = picture();
  expect_ok(R"({"command":"set","key":"legend.shown","value":true})");
  const auto with = picture();
  EXPECT_EQ(session_->picture_size(), glm::ivec2(400, 300));
  EXPECT_EQ(with.size(), without.size());
  EXPECT_NE(with, without);
  session_->render(Quality::draft);
  EXPECT_EQ(session_->picture_size(), glm::ivec2(200, 150));
  EXPECT_EQ(session_->rgba().size(), 4u * 200 * 150);
  EXPECT_FALSE(apply(R"({"command":"pick","x":399,"y":150})")["hit"]) << "nothing is there but letters";
  // The window is too small for it: the picture is drawn without it, and the state has the reason.
  expect_ok(R"({"command":"resize","width":20,"height":20})");
  EXPECT_FALSE(state()["legend_fault"].get<std::string>().empty());
  EXPECT_TRUE(session_->render(Quality::full));
  EXPECT_EQ(session_->picture_size(), glm::ivec2(20, 20));
}

TEST_F(FigureSession, WithoutItsFileNothingCanBeDrawnBeside) {
  PreviewState view;
  view.size = {80, 60};
  PreviewSession session(make_cpu_preview_renderer(), session_->structure(), view, std::nullopt, folder_.path());
  const Json reply = session.apply({{"command", "add"}, {"key", "figure.sticks"}, {"value", "all"}});
  EXPECT_FALSE(reply["ok"]);
  EXPECT_NE(reply["error"].get<std::string>().find("cannot be read again"), std::string::npos);
}

class CompanionSession : public FigureSession {
 protected:
  CompanionSession() : FigureSession(std::nullopt) {}
};

TEST_F(CompanionSession, TheLigandIsBesideTheSurfaceAndNoObjectOfTheUser) {
  EXPECT_EQ(session_->structure().atoms.size(), 4u);
  expect_ok(R"({"command":"zoom_to","selection":"ligand"})");
  const Json pick = apply(R"({"command":"pick","x":40,"y":30})");
  ASSERT_TRUE(pick["hit"]) << pick;
  EXPECT_EQ(pick["residue"], "LIG");
  EXPECT_EQ(pick["kind"], "shape");
  EXPECT_TRUE(values()["figure.object"].empty());
  expect_ok(R"({"command":"set","key":"surface.show","value":"within 5 of ligand"})");
  expect_ok(R"({"command":"add","key":"surface.color","value":"within 4.6 of ligand=red"})");
}

TEST_F(FigureSession, ObjectsHaveLooksAndAtomsOfTheirOwn) {
  expect_ok(R"({"command":"add","key":"figure.object","value":{"selection":"ligand","color":"gold","specular":0.8}})");
  const Json told = values()["figure.object"];
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0],
            Json::parse(R"({"representation":"surface","selection":"ligand","color":"#ffd700","specular":0.8})"));
  // A ligand that is not an atom of the surface can be picked.
  expect_ok(R"({"command":"set","key":"surface.shown","value":false})");
  expect_ok(R"({"command":"zoom_to","selection":"ligand"})");
  const Json pick = apply(R"({"command":"pick","x":40,"y":30})");
  ASSERT_TRUE(pick["hit"]) << pick;
  EXPECT_EQ(pick["residue"], "LIG");
  EXPECT_NE(pick["kind"], "shape") << pick;
  EXPECT_TRUE(pick["exposed_area"].is_null()) << "not of the molecule's surface";
  // Movements of a slider are one step, and merge on their way.
  expect_ok(R"({"command":"end_step"})");
  const auto slid = [](const char* opacity, int index) {
    return Json{{"command", "set"},
                {"key", "figure.object"},
                {"index", index},
                {"value", {{"selection", "ligand"}, {"opacity", opacity}}}};
  };
  for (const char* opacity : {"0.8", "0.5", "0.2"}) EXPECT_TRUE(session_->apply(slid(opacity, 0))["ok"]);
  expect_ok(R"({"command":"undo"})");
  EXPECT_EQ(values()["figure.object"], told);
  Json first = slid("0.8", 0);
  EXPECT_TRUE(merge_commands(first, slid("0.7", 0)));
  EXPECT_EQ(first, slid("0.7", 0));
  EXPECT_FALSE(merge_commands(first, slid("0.7", 1)));
  Json added = slid("0.8", 0);
  added["command"] = "add";
  added.erase("index");
  EXPECT_FALSE(merge_commands(added, Json(added))) << "two objects";
  first["value"] = nullptr;
  EXPECT_FALSE(merge_commands(first, Json(first))) << "both are removed";
}

// Entries of lists are added, changed and removed by index.
TEST_F(FigureSession, ListsHaveEntries) {
  const auto add = [&](const char* key, const Json& value) {
    return session_->apply({{"command", "add"}, {"key", key}, {"value", value}});
  };
  EXPECT_EQ(add("surface.opacity", 0.5)["index"], 0);
  EXPECT_EQ(add("surface.opacity", "name O=0.25")["index"], 1);
  EXPECT_EQ(add("surface.opacity", "name C=0.75")["index"], 2);
  EXPECT_EQ(add("surface.opacity", "name O=0.125")["index"], 2) << "the last one of the same atoms counts";
  EXPECT_EQ(values()["surface.opacity"], Json({0.5, "name C=0.75", "name O=0.125"}));
  expect_ok(R"({"command":"set","key":"surface.opacity","index":0,"value":0.375})");
  expect_ok(R"({"command":"set","key":"surface.opacity","index":1,"value":null})");
  EXPECT_EQ(values()["surface.opacity"], Json({0.375, "name O=0.125"}));
  EXPECT_EQ(add("surface.color", "name O=red")["index"], 1) << "after the scheme";
  EXPECT_EQ(add("surface.color", "name C=gold")["index"], 2);
  expect_ok(R"({"command":"set","key":"surface.color","index":0,"value":"chain"})");
  EXPECT_EQ(values()["surface.color"], Json({"chain", "name O=#ff0000", "name C=#ffd700"}));
  expect_ok(R"({"command":"set","key":"surface.color","index":1,"value":null})");
  EXPECT_EQ(values()["surface.color"], Json({"chain", "name C=#ffd700"}));
  EXPECT_NE(add("surface.clip", "x<100").value("note", "").find("x<100"), std::string::npos);
  expect_ok(R"({"command":"end_step"})");
  const int steps = SessionCase::state()["undo"];
  for (const char* plane : {"x<3", "x<2", "x<1"})
    EXPECT_TRUE(session_->apply({{"command", "set"}, {"key", "surface.clip"}, {"index", 0}, {"value", plane}})["ok"]);
  EXPECT_EQ(SessionCase::state()["undo"], steps + 1) << "a slider";
}

TEST_F(FigureSession, WhatItCannotShowIsRefusedInOneLine) {
  const auto refused = [&](const std::string& command, const std::string& because) {
    const Json before = state();
    const Json reply = apply(command);
    EXPECT_FALSE(reply["ok"]) << command;
    EXPECT_NE(reply.value("error", std::string()).find(because), std::string::npos) << reply;
    EXPECT_EQ(reply.value("error", std::string()).find('\n'), std::string::npos) << reply;
    EXPECT_EQ(state(), before) << command;
  };
  for (const char* scheme : {"buried", "rmsf", "relative-accessibility", "component"})
    refused(std::string(R"({"command":"set","key":"surface.color","value":")") + scheme + "\"}",
            "needs more than atoms");
  refused(R"({"command":"add","key":"surface.color","value":"all=buried"})", "needs more than atoms");
  refused(R"({"command":"add","key":"figure.object","value":{"selection":"ligand","color":"rmsf"}})",
          "needs more than atoms");
  refused(R"({"command":"set","key":"surface.shown","value":false})", "nothing would be shown");
  refused(R"({"command":"add","key":"figure.object","value":{"selection":"resn XYZ"}})", "--object");
  refused(R"({"command":"add","key":"figure.object","value":{"selection":"ligand","colour":"red"}})", "colour");
  refused(R"({"command":"set","key":"figure.object","index":0,"value":{"selection":"ligand"}})", "index");
  refused(R"({"command":"save","path":"fig.json"})", "scenes");
  refused(R"({"command":"open","path":"fig.json"})", "scenes");
}

// Objects next to the surface do not turn the molecule, nor does a later change of the size.
TEST_F(FigureSession, ShapesBesideTheSurfaceDoNotTurnTheMolecule) {
  const Json before = apply(R"({"command":"state"})")["camera"];
  const auto camera = [&] { return apply(R"({"command":"state"})")["camera"]; };
  for (const char* command : {R"({"command":"add","key":"figure.sticks","value":"ligand"})",
                              R"({"command":"add","key":"figure.object","value":{"selection":"ligand"}})",
                              R"({"command":"set","key":"figure.object","value":null})"}) {
    expect_ok(command);
    EXPECT_EQ(camera(), before) << command;
  }
  const auto side = [](const Json& seen) {
    const auto point = [&](const char* key) {
      return glm::dvec3(seen[key][0].get<double>(), seen[key][1].get<double>(), seen[key][2].get<double>());
    };
    return glm::normalize(point("target") - point("position"));
  };
  expect_ok(R"({"command":"resize","width":90,"height":60})");
  EXPECT_NE(camera(), before) << "all is in view again";
  EXPECT_LT(glm::length(side(camera()) - side(before)), 1e-9);
}

TEST_F(FigureSession, SchemesThatAreOfferedAreThoseItCanShow) {
  const auto offered = [](PreviewSession& session) {
    std::set<std::string> words;
    const Json choices = session.apply({{"command", "choices"}});
    for (const Json& scheme : choices["schemes"])
      if (!scheme.contains("lacks")) words.insert(scheme["word"]);
    for (const std::string& word : words) {
      const Json reply = session.apply({{"command", "set"}, {"key", "surface.color"}, {"value", word}});
      EXPECT_TRUE(reply["ok"]) << word << reply;
    }
    return words;
  };
  const std::set<std::string> words = offered(*session_);
  for (const char* word : {"buried", "rmsf", "relative-accessibility", "component", "volume", "copy", "file"})
    EXPECT_FALSE(words.contains(word)) << word;
  for (const char* word : {"element", "chain", "bfactor"}) EXPECT_TRUE(words.contains(word)) << word;
  // The state has the reasons for the other schemes.
  std::map<std::string, std::string> lacks;
  const Json choices = apply(R"({"command":"choices"})");
  for (const Json& scheme : choices["schemes"]) lacks[scheme["word"].get<std::string>()] = scheme.value("lacks", "");
  EXPECT_EQ(lacks["charge"], "has no partial charges to colour by");
  EXPECT_EQ(lacks["model"], "has one model");
  EXPECT_EQ(lacks["copy"], "has no copies");
  EXPECT_EQ(lacks["plddt"], "");  // this scheme is available
  EXPECT_EQ(lacks["secondary"], "");
  // An assembly has copies, and the session can return to the scheme of numbers that it began with.
  Structure assembly = session_->structure();
  for (std::size_t n = 0; n < assembly.atoms.size(); ++n) assembly.atoms[n].copy = static_cast<std::uint32_t>(n % 2);
  PreviewState view;
  view.size = {80, 60};
  view.molecule.color.by = ColorScheme::By::file;
  view.molecule.color.file = {.path = "numbers.txt", .numbers = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}};
  PreviewSession session(make_cpu_preview_renderer(), assembly, view, std::nullopt, folder_.path());
  const std::set<std::string> more = offered(session);
  EXPECT_TRUE(more.contains("copy"));
  EXPECT_TRUE(more.contains("file"));
}

}  // namespace
}  // namespace meniscus::test
