// SPDX-License-Identifier: BSD-3-Clause
// The list of contents and its selections, the places of atoms, and atoms that are hidden, shown again and looked into.
#include <algorithm>
#include <numeric>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/structure/formats/read_structure.h"
#include "tests/preview/session_case.h"

namespace meniscus::test {
namespace {

// Chain A has an insertion code, a number below 0 and a modified residue; a sugar, a ligand and two ions are in other
// chains, one of which has a keyword as its name, and one no name; and there are waters.
constexpr std::string_view kMany = R"(ATOM      1  N   ALA A  -1       0.000   0.000   0.000  1.00 10.00           N
ATOM      2  CA  ALA A  -1       1.458   0.000   0.000  1.00 20.00           C
ATOM      3  C   ALA A  -1       2.009   1.420   0.000  1.00 30.00           C
ATOM      4  O   ALA A  -1       1.251   2.390   0.000  1.00 40.00           O
HETATM    5  N   MSE A   5A      3.332   1.536   0.000  1.00 10.00           N
HETATM    6  CA  MSE A   5A      3.988   2.839   0.000  1.00 20.00           C
HETATM    7  C   MSE A   5A      5.504   2.693   0.000  1.00 30.00           C
HETATM    8  O   MSE A   5A      6.030   1.580   0.000  1.00 40.00           O
ATOM      9  N   GLY B   1      20.000   0.000   0.000  1.00 10.00           N
ATOM     10  CA  GLY B   1      21.458   0.000   0.000  1.00 20.00           C
ATOM     11  C   GLY B   1      22.009   1.420   0.000  1.00 30.00           C
ATOM     12  O   GLY B   1      21.251   2.390   0.000  1.00 40.00           O
HETATM   13  C1  NAG B   2      30.000   0.000   0.000  1.00 40.00           C
HETATM   14  O5  NAG B   2      31.400   0.000   0.000  1.00 40.00           O
HETATM   15  C1  ION X   2      10.000   5.000   0.000  1.00 40.00           C
HETATM   16  O1  ION X   2      11.200   5.000   0.000  1.00 40.00           O
HETATM   17 ZN    ZN   301       9.000   9.000   0.000  1.00 40.00          ZN
HETATM   18 ZN    ZN   302      15.000   9.000   0.000  1.00 40.00          ZN
HETATM   19  O   HOH A 401       4.000   9.000   0.000  1.00 40.00           O
HETATM   20  O   HOH   402       4.000  15.000   0.000  1.00 40.00           O
END
)";

class ContentsSession : public SessionCase {
 protected:
  void open(const std::string& file, const ReadOptions& reading = {}) {
    file_ = file;
    SessionContext context;
    context.read_shown = reader_of(file, reading);
    context.aim = [](const Scene&, const Structure&) {
      Camera camera;
      camera.position = {0.0, 0.0, 77.0};
      return camera;
    };
    ReadOptions first = reading;
    FigureRequest().mark_atoms(first);
    begin(read_structure(file, first), context);
  }

  Json contents() { return apply(R"({"command":"contents"})")["entries"]; }
  Json entry(const std::string& name) {
    for (const Json& entry : contents())
      if (entry["name"] == name) return entry;
    return nullptr;
  }
  std::size_t count(const std::string& selection) const {
    ReadOptions reading;
    reading.selection = parse_selection(selection);
    return read_structure(file_, reading).atoms.size();
  }

  std::string file_;
};

TEST_F(ContentsSession, EverySelectionMeansExactlyItsAtoms) {
  open(folder_.file("many.pdb", kMany));
  const Json entries = contents();
  std::size_t atoms = 0;
  for (const Json& entry : entries) {
    EXPECT_EQ(count(entry["selection"]), entry["atoms"].get<std::size_t>()) << entry;
    atoms += entry["atoms"].get<std::size_t>();
  }
  EXPECT_EQ(atoms, 20);
  EXPECT_EQ(entry("Chain A")["selection"], "chain A and polymer");
  EXPECT_EQ(entry("ION X 2")["selection"], "chain X and resid 2 and resname \"ION\"");
  EXPECT_EQ(entry("ZN 302")["selection"], "chain \"\" and resid 302 and resname ZN");
  EXPECT_EQ(entry("Water")["atoms"], 2);
  EXPECT_EQ(entry("Water")["shown"], 0);
  EXPECT_EQ(entry("Chain B")["kind"], "protein");
  const Json residues = apply(R"({"command":"contents","selection":"chain A and polymer"})")["residues"];
  EXPECT_EQ(residues, Json::parse(R"([["A","-1","ALA"],["M","5A","MSE"]])"));
  EXPECT_EQ(count("chain A and resid 5A and resname MSE"), 4);
}

TEST_F(ContentsSession, ManyMoleculesOfOneNameAreOneEntry) {
  std::string text(kMany.substr(0, kMany.find("END")));
  for (int n = 0; n < 21; ++n)
    text += fmt::format("HETATM  {:>3}  S   SO4 S {:>3}    {:8.3f}  40.000   0.000  1.00 40.00           S\n", 100 + n,
                        n, 10.0 * n);
  open(folder_.file("salt.pdb", text));
  EXPECT_EQ(entry("SO4")["residues"], 21);
  EXPECT_EQ(count(entry("SO4")["selection"]), 21);
}

TEST_F(ContentsSession, ALargeMoleculeHasAShortList) {
  std::string text;
  for (int chain = 0; chain < 26; ++chain)
    for (int n = 0; n < 60; ++n)
      text += fmt::format("HETATM{:5d}  C1  L{:02d} {}{:4d}    {:8.3f}{:8.3f}   0.000  1.00 40.00           C\n",
                          60 * chain + n, n, static_cast<char>('A' + chain), n, 10.0 * n, 10.0 * chain);
  open(folder_.file("large.pdb", text));
  const Json reply = apply(R"({"command":"contents"})");
  EXPECT_LE(reply["entries"].size(), 1000);
  EXPECT_EQ(reply["left_out"], 0);  // more than 20 of each name are one entry
  EXPECT_EQ(reply["entries"].size(), 60);
}

TEST_F(ContentsSession, HidesAndShowsAgain) {
  open(folder_.file("many.pdb", kMany));
  expect_ok(R"({"command":"take_away","selection":"chain A and polymer"})");
  EXPECT_EQ(entry("Chain A")["shown"], 0);
  EXPECT_EQ(values()["surface.show"], "all and not (chain A and polymer)");
  // The last shown part of the surface is hidden: only the objects next to it remain.
  expect_ok(R"({"command":"take_away","selection":"chain B and polymer"})");
  EXPECT_EQ(entry("Chain B")["shown"], 0);
  EXPECT_EQ(values()["surface.shown"], false);
  expect_ok(R"({"command":"bring_back","selection":"chain B and polymer"})");
  EXPECT_EQ(entry("Chain A")["shown"], 0);
  EXPECT_EQ(entry("Chain B")["shown"], 4);
  expect_ok(R"({"command":"bring_back","selection":"chain A and polymer"})");
  EXPECT_EQ(values()["surface.show"], nullptr);
  EXPECT_EQ(entry("Chain A")["shown"], 8);
  // Companions of the surface are hidden one by one.
  const std::string zinc = R"json("selection":"chain \"\" and resid 302 and resname ZN"})json";
  EXPECT_EQ(entry("ZN 302")["shown"], 1);
  expect_ok(R"({"command":"take_away",)" + zinc);
  EXPECT_EQ(entry("ZN 302")["shown"], 0);
  EXPECT_EQ(entry("ZN 301")["shown"], 1);
  EXPECT_EQ(entry("ION X 2")["shown"], 2);
  expect_ok(R"({"command":"bring_back",)" + zinc);
  EXPECT_EQ(entry("ZN 302")["shown"], 1);
  expect_ok(R"({"command":"bring_back","selection":"water"})");
  EXPECT_EQ(entry("Water")["shown"], 2);
  expect_ok(R"({"command":"take_away","selection":"water"})");
  EXPECT_EQ(entry("Water")["shown"], 0);
  // The end of a dashed line is not drawn.
  expect_ok(
      R"({"command":"add","key":"figure.object","value":{"representation":"distance","selection":"chain A to chain B"}})");
  expect_ok(R"({"command":"take_away","selection":"chain A and polymer"})");
  EXPECT_EQ(entry("Chain A")["shown"], 0);
}

TEST_F(ContentsSession, LocatesAtomsInThePicture) {
  open(folder_.file("many.pdb", kMany));
  const Json found = apply(R"({"command":"locate","selection":"resid 5A or chain X"})");
  EXPECT_EQ(found["atoms"], 6);
  std::size_t count = 0;
  for (const Json& range : found["places"]) count += range[1].get<std::size_t>();
  EXPECT_EQ(count, 6);
  EXPECT_EQ(found["points"][0], Json::parse("[3.332,1.536,0.0]"));
  EXPECT_EQ(found["picture"], Json::parse("[80,60]"));
  EXPECT_EQ(apply(R"({"command":"locate","selection":"none"})")["atoms"], 0);
}

TEST_F(ContentsSession, LooksInto) {
  open(folder_.file("many.pdb", kMany));
  const Json reply = apply(R"({"command":"look_into","selection":"resname \"ION\""})");
  EXPECT_EQ(reply["atoms"], 2) << reply;
  EXPECT_EQ(values()["surface.clip"], Json::parse(R"json(["before first (resname \"ION\")"])json"));
  EXPECT_EQ(state()["camera"]["position"][2], 77.0);
  EXPECT_TRUE(values()["figure.object"].empty());  // the object is drawn already
  // At another place there is one cut, and the residue of the surface is drawn inside it.
  expect_ok(R"({"command":"look_into","selection":"resid 5A"})");
  EXPECT_EQ(values()["surface.clip"], Json::parse(R"json(["before first (resid 5A)"])json"));
  EXPECT_EQ(values()["figure.object"][0]["representation"], "sticks");
  expect_ok(R"({"command":"undo"})");
  expect_ok(R"({"command":"undo"})");
  EXPECT_TRUE(values()["surface.clip"].empty());
  EXPECT_FALSE(apply(R"({"command":"look_into","selection":"resname NONE"})")["ok"]);
  EXPECT_TRUE(values()["surface.clip"].empty());
}

TEST_F(ContentsSession, AskingChangesNothingAndIsNotRecorded) {
  EXPECT_TRUE(is_question(Json::parse(R"({"command":"contents"})")));
  EXPECT_TRUE(is_question(Json::parse(R"({"command":"locate","selection":"all"})")));
  EXPECT_FALSE(is_question(Json::parse(R"({"command":"look_into","selection":"all"})")));
}

}  // namespace
}  // namespace meniscus::test
