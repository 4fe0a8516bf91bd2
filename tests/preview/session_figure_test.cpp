// SPDX-License-Identifier: BSD-3-Clause
// Commands that change what a figure shows, what they refuse, and undo and redo of them.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/preview/camera_motion.h"
#include "app/preview/command_json.h"
#include "core/structure/formats/read_structure.h"
#include "tests/preview/session_case.h"

namespace meniscus::test {
namespace {

// A peptide bond, a water, and a ligand.
constexpr std::string_view kThree = R"(ATOM      1  N   ALA A   1       0.000   0.000   0.000  1.00 10.00           N
ATOM      2  CA  ALA A   1       1.458   0.000   0.000  1.00 20.00           C
ATOM      3  C   ALA A   1       2.009   1.420   0.000  1.00 30.00           C
ATOM      4  O   ALA A   1       1.251   2.390   0.000  1.00 40.00           O
HETATM    5  C1  LIG B   2       6.000   0.000   0.000  1.00 40.00           C
HETATM    6  O1  LIG B   2       7.200   0.000   0.000  1.00 40.00           O
HETATM    7  O   HOH B   3       4.000   5.000   0.000  1.00 40.00           O
END
)";

class FigureSession : public SessionCase {
 protected:
  explicit FigureSession(const std::optional<Selection>& selection = parse_selection("polymer")) {
    const std::string file = folder_.file("three.pdb", kThree);
    ReadOptions reading;
    reading.selection = selection;
    SessionContext context;
    context.read_shown = [file, reading](const FigureRequest& figure, std::size_t) {
      ReadOptions shown = reading;
      figure.mark_atoms(shown);
      return read_structure(file, shown);
    };
    begin(read_structure(file, reading), context);
  }

  /// The state without what every command changes.
  Json state() {
    Json state = SessionCase::state();
    for (const char* key : {"revision", "undo", "redo", "drawn_by"}) state.erase(key);
    return state;
  }
};

constexpr const char* kEdits[] = {
    R"({"command":"represent","as":"sticks","selection":"ligand"})",
    R"({"command":"represent","as":"spheres","selection":"resn HOH"})",
    R"({"command":"remove","of":"representations","index":0})",
    R"({"command":"object","object":{"selection":"ligand","color":"red"}})",
    R"({"command":"object","object":{"representation":"spheres","selection":"resn HOH","color":"#00ff00"}})",
    R"({"command":"set","key":"surface.shown","value":false})",
    R"({"command":"object","index":0,"object":{"selection":"ligand","color":"blue","opacity":"0.6","clip":"x<6.5"}})",
    R"({"command":"set","key":"surface.shown","value":true})",
    R"({"command":"remove","of":"objects","index":1})",
    R"({"command":"set","key":"surface.show","value":"within 5 of ligand"})",
    R"({"command":"set","key":"surface.show","value":null})",
    R"({"command":"set","key":"surface.color","value":"bfactor"})",
    R"({"command":"set","key":"surface.map","value":"magma"})",
    R"({"command":"set","key":"surface.color_range","value":"10:20"})",
    R"({"command":"paint","selection":"name CA","color":"red"})",
    R"({"command":"opacity","opacity":0.5,"selection":"name O"})",
    R"({"command":"set","key":"surface.film_opacity","value":true})",
    R"({"command":"cut","plane":"x<1"})",
    R"({"command":"set","key":"surface.cap_color","value":"#00ff00"})",
    R"({"command":"orbit","dx":0.0,"dy":0.1})",
    R"({"command":"set","key":"surface.cap_hatching","value":0.5})",
    R"({"command":"hide","selection":"name N"})",
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
      pictures.back() = picture();  // not undone: it is the page's
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
    expected["width"] = 400;  // whatever the page was then
    expected["height"] = 300;
    Json now = state();
    for (Json* json : {&expected, &now}) {
      json->erase("camera"), json->erase("look");
      for (const char* kind : {"silhouettes", "outer_lines", "inner_lines", "part_lines", "patch_lines"})
        (*json)["values"].erase(std::string("look.") + kind);
    }
    now["legend"].erase("fault");
    expected["legend"].erase("fault");
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
  expect_ok(R"({"command":"zoom","factor":1.1})");
  const Json first = state();
  expect_ok(R"({"command":"end_step"})");
  expect_ok(R"({"command":"pan","dx":0.02,"dy":0.01})");
  EXPECT_EQ(apply(R"({"command":"state"})")["undo"], 2);
  expect_ok(R"({"command":"undo"})");
  EXPECT_EQ(state(), first);
  expect_ok(R"({"command":"undo"})");
  EXPECT_EQ(state(), before);
  // Something new forgets what was undone.
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
  expect_ok(R"({"command":"cut","plane":"x<1"})");
  const Json before = apply(R"({"command":"state"})");
  const std::vector<std::pair<const char*, const char*>> kRefused{
      {R"({"command":"represent","as":"sticks","selection":"chain Q"})", "chain Q"},
      {R"({"command":"represent","as":"sticks","selection":"chain ("})", "represent"},
      {R"({"command":"represent","as":"lines","selection":"all"})",
       "one of sticks, balls, spheres, tube, bases, glycans"},
      {R"({"command":"paint","selection":"all","color":"rot"})", "rot"},
      {R"({"command":"paint","selection":"all","color":"file"})", "--color-by-file"},
      {R"({"command":"opacity","opacity":1.5})", "from 0 to 1"},
      {R"({"command":"opacity","opacity":1,"index":0})", "index"},
      {R"({"command":"cut","plane":"x=1"})", "there is no < or >"},
      {R"({"command":"cut","plane":"x<2","index":1})", "from 0 to 0"},
      {R"({"command":"set","key":"surface.cap_color","value":"greenish"})", "cap_color: 'greenish'"},
      {R"({"command":"set","key":"surface.cap_hatching","value":-1})", "cap_hatching: '-1'"},
      {R"({"command":"set","key":"surface.cap_hatching","value":[1]})", "cap_hatching: '[1]'"},
      {R"({"command":"set","key":"surface.film_opacity","value":"perhaps"})", "neither true nor false"},
      {R"({"command":"set","key":"surface.shown","value":7})", "neither true nor false"},
      {R"({"command":"set","key":"surface.prob","value":2})", "did you mean surface.probe?"},
      {R"({"command":"set","key":"surface.cap_hatching"})", "value"},
      {R"({"command":"remove","of":"rules","index":0})", "there are no rules"},
      {R"({"command":"remove","of":"cuts","index":1})", "index"},
      {R"({"command":"remove","of":"atoms"})", "one of"},
      {R"({"command":"hide","selection":"all"})", "nothing would be left"},
      {R"({"command":"set","key":"surface.show","value":"resid 9"})", "nothing would be left"},
      {R"({"command":"set","key":"look.preset","value":"loud"})", "publication"},
      {R"({"command":"set","key":"legend.place","value":"left"})", "one of auto, right, below"},
      {R"({"command":"set","key":"surface.color_range","value":"9:1"})", "lo:hi"},
      {R"({"command":"set","key":"surface.color_range","value":"1:9"})", "colours by a number"},
      {R"({"command":"set","key":"shapes.stick_radius","value":0})", "stick_radius: '0'"},
      {R"({"command":"set","key":"surface.kind","value":"ms"})", "one of ses, sas, vdw"},
      {R"({"command":"recall_view","name":"front"})", "no view is called"},
      {R"({"command":"save_view","name":""})", "1 to 60"},
      {R"({"command":"center","x":0,"y":0})", "nothing is there"},
      {R"({"command":"zoom","factor":2,"x":3})", "give both"},
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
  expect_ok(R"({"command":"represent","as":"balls","selection":"resn LIG"})");
  EXPECT_EQ(apply(R"({"command":"zoom_to","selection":"resn LIG"})")["atoms"], 2);
  EXPECT_NE(picture(), alone);
  const Json pick = apply(R"({"command":"pick","x":40,"y":30})");
  ASSERT_TRUE(pick["hit"]);
  EXPECT_EQ(pick["residue"], "LIG");
  EXPECT_EQ(pick["kind"], "shape");
  EXPECT_TRUE(pick["exposed_area"].is_null());
  expect_ok(R"({"command":"remove","of":"representations"})");
  expect_ok(R"({"command":"reset_view"})");
  EXPECT_EQ(picture(), alone);
}

TEST_F(FigureSession, NamedViewsAndTheFirstOneComeBack) {
  const Json first = state()["camera"];
  expect_ok(R"({"command":"orbit","dx":0.3,"dy":0})");
  const Json side = state()["camera"];
  expect_ok(R"({"command":"save_view","name":"side"})");
  expect_ok(R"({"command":"orbit","dx":0.3,"dy":0})");
  EXPECT_EQ(state()["views"], Json::array({"side"}));
  expect_ok(R"({"command":"recall_view","name":"side"})");
  EXPECT_EQ(state()["camera"], side);
  expect_ok(R"({"command":"reset_view"})");
  EXPECT_EQ(state()["camera"], first);
  expect_ok(R"({"command":"undo"})");
  EXPECT_EQ(state()["camera"], side);
  expect_ok(R"({"command":"forget_view","name":"side"})");
  EXPECT_EQ(state()["views"], Json::array());
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

TEST_F(FigureSession, AClickCentresAndZoomStaysAtTheCursor) {
  const Json before = state()["camera"];
  const Json pick = apply(R"({"command":"pick","x":30,"y":35})");
  ASSERT_TRUE(pick["hit"]);
  expect_ok(R"({"command":"center","x":30,"y":35})");
  EXPECT_EQ(state()["camera"]["target"], pick["position"]);
  expect_ok(R"({"command":"undo"})");
  EXPECT_EQ(state()["camera"], before) << "a double click is taken back, too";
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    Camera camera;
    camera.position = {0, 0, 20};
    camera.projection = projection;
    camera.height = 10.0;
    // What lies in the plane of the target under the cursor.
    const auto at = [](const Camera& from, glm::dvec2 place) {
      const ViewBasis basis = view_basis(from);
      return from.target + (basis.right * place.x - basis.up * place.y) * height_at_target(from);
    };
    const glm::dvec2 place{0.2, -0.1};
    const Camera near = zoomed_at(camera, 3.0, place);
    EXPECT_LT(glm::distance(at(near, place), at(camera, place)), 1e-12);
    EXPECT_NEAR(height_at_target(camera) / height_at_target(near), 3.0, 1e-12);
  }
}

// While a slow picture is drawn notches become one, however many: too far is as far as it goes, and no place is lost.
TEST_F(FigureSession, AFastWheelOverASlowPictureIsNotRefused) {
  for (const double notch : {1.1, 2.0, 1e200, 1.0 / 1.1, 0.5, 1e-200}) {
    const Json one{{"command", "zoom"}, {"factor", notch}, {"x", 3}, {"y", 4}};
    for (const int count : {2, 100, 10000}) {
      SCOPED_TRACE(::testing::Message() << count << " times " << notch);
      Json wheel = one;
      for (int n = 1; n < count; ++n) ASSERT_TRUE(merge_commands(wheel, one));
      const double before = height_at_target(session_->state().camera);
      const Json reply = session_->apply(wheel);
      ASSERT_TRUE(reply["ok"]) << reply;
      const double grown = before / height_at_target(session_->state().camera);
      EXPECT_GE(notch > 1.0 ? grown : 1.0 / grown, std::min(10.0, 0.9 * std::pow(std::max(notch, 1.0 / notch), count)));
      expect_ok(R"({"command":"undo"})");
    }
  }
  Json wheel{{"command", "zoom"}, {"factor", 1.1}, {"x", 3}, {"y", 4}};
  EXPECT_FALSE(merge_commands(wheel, {{"command", "zoom"}, {"factor", 1.1}, {"x", 3}, {"y", 5}}));
  EXPECT_FALSE(merge_commands(wheel, {{"command", "zoom"}, {"factor", 1.1}}));
  // What is not a factor is not hidden among others.
  for (const double wrong : {0.0, -1.0}) {
    wheel["factor"] = wrong;
    EXPECT_FALSE(merge_commands(wheel, Json(wheel)));
    EXPECT_FALSE(session_->apply(wheel)["ok"]) << wrong;
  }
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
  // Too small for it: the picture is drawn without, and the state says why.
  expect_ok(R"({"command":"resize","width":20,"height":20})");
  EXPECT_FALSE(state()["legend"].value("fault", "").empty());
  EXPECT_TRUE(session_->render(Quality::full));
  EXPECT_EQ(session_->picture_size(), glm::ivec2(20, 20));
}

TEST_F(FigureSession, WithoutItsFileNothingCanBeDrawnBeside) {
  PreviewState view;
  view.size = {80, 60};
  PreviewSession session(make_cpu_preview_renderer(), session_->structure(), view, std::nullopt, folder_.path());
  const Json reply = session.apply({{"command", "represent"}, {"as", "sticks"}, {"selection", "all"}});
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
  EXPECT_TRUE(state()["objects"].empty());
  expect_ok(R"({"command":"set","key":"surface.show","value":"within 5 of ligand"})");
  expect_ok(R"({"command":"paint","selection":"within 4.6 of ligand","color":"red"})");
}

TEST_F(FigureSession, ObjectsHaveLooksAndAtomsOfTheirOwn) {
  expect_ok(R"({"command":"object","object":{"selection":"ligand","color":"gold","specular":0.8}})");
  const Json told = state()["objects"];
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0],
            Json::parse(R"({"representation":"surface","selection":"ligand","color":"#ffd700","specular":0.8})"));
  // The ligand is not an atom of the surface, yet it is picked.
  expect_ok(R"({"command":"set","key":"surface.shown","value":false})");
  expect_ok(R"({"command":"zoom_to","selection":"ligand"})");
  const Json pick = apply(R"({"command":"pick","x":40,"y":30})");
  ASSERT_TRUE(pick["hit"]) << pick;
  EXPECT_EQ(pick["residue"], "LIG");
  EXPECT_NE(pick["kind"], "shape") << pick;
  EXPECT_TRUE(pick["exposed_area"].is_null()) << "not of the molecule's surface";
  // A slider is one step, and merges on its way.
  expect_ok(R"({"command":"end_step"})");
  for (const char* opacity : {"0.8", "0.5", "0.2"})
    expect_ok(std::string(R"({"command":"object","index":0,"object":{"selection":"ligand","opacity":")") + opacity +
              "\"}}");
  expect_ok(R"({"command":"undo"})");
  EXPECT_EQ(state()["objects"], told);
  Json first = Json::parse(R"({"command":"object","index":0,"object":{"selection":"ligand","opacity":"0.8"}})");
  Json other = first;
  other["object"]["opacity"] = "0.7";
  EXPECT_TRUE(merge_commands(first, other));
  EXPECT_EQ(first["object"]["opacity"], "0.7");
  other["index"] = 1;
  EXPECT_FALSE(merge_commands(first, other));
  first.erase("index"), other.erase("index");
  EXPECT_FALSE(merge_commands(first, other)) << "two objects";
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
  refused(R"({"command":"paint","selection":"all","color":"buried"})", "needs more than atoms");
  refused(R"({"command":"object","object":{"selection":"ligand","color":"rmsf"}})", "needs more than atoms");
  refused(R"({"command":"set","key":"surface.shown","value":false})", "nothing would be shown");
  refused(R"({"command":"object","object":{"selection":"resn XYZ"}})", "--object");
  refused(R"({"command":"object","object":{"selection":"ligand","colour":"red"}})", "colour");
  refused(R"({"command":"object","index":0,"object":{"selection":"ligand"}})", "index");
  refused(R"({"command":"save","path":"fig.json"})", "scenes");
  refused(R"({"command":"open","path":"fig.json"})", "scenes");
}

// What comes beside the surface turns nothing, and a later change of the size neither.
TEST_F(FigureSession, ShapesBesideTheSurfaceDoNotTurnTheMolecule) {
  const Json before = apply(R"({"command":"state"})")["camera"];
  const auto camera = [&] { return apply(R"({"command":"state"})")["camera"]; };
  for (const char* command :
       {R"({"command":"represent","as":"sticks","selection":"ligand"})",
        R"({"command":"object","object":{"selection":"ligand"}})", R"({"command":"remove","of":"objects"})"}) {
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
  // Of the others the reason is told.
  std::map<std::string, std::string> lacks;
  const Json choices = apply(R"({"command":"choices"})");
  for (const Json& scheme : choices["schemes"]) lacks[scheme["word"].get<std::string>()] = scheme.value("lacks", "");
  EXPECT_EQ(lacks["charge"], "has no partial charges to colour by");
  EXPECT_EQ(lacks["model"], "has one model");
  EXPECT_EQ(lacks["copy"], "has no copies");
  EXPECT_EQ(lacks["plddt"], "");  // nothing speaks against it
  EXPECT_EQ(lacks["secondary"], "");
  // An assembly has copies, and a scheme of numbers that it was begun with is there to be returned to.
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
