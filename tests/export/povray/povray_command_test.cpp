// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export povray` with files that try to write scene code.
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

// Returns two mmCIF atoms with the given names. Text fields hold anything but newlines.
std::string mmcif(const std::string& atom_name, const std::string& residue, const std::string& chain) {
  std::string text =
      "data_x\nloop_\n_atom_site.group_PDB\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.label_atom_id\n"
      "_atom_site.label_alt_id\n_atom_site.label_comp_id\n_atom_site.label_asym_id\n_atom_site.label_entity_id\n"
      "_atom_site.label_seq_id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.occupancy\n"
      "_atom_site.B_iso_or_equiv\n_atom_site.auth_seq_id\n_atom_site.auth_asym_id\n_atom_site.pdbx_PDB_model_num\n";
  for (const char* const x : {"0.0", "3.5"})
    text += fmt::format("ATOM {} C {} . {} {} 1 1 {} 0.0 0.0 1.0 10.0 1 {} 1\n", x[0] == '0' ? 1 : 2, atom_name,
                        residue, chain, x, chain);
  return text;
}

TEST(PovrayCommand, TextOfAMoleculeNeverReachesTheScene) {
  const test::TemporaryFolder folder;
  const std::string plain = folder.file("plain.cif", mmcif("CA", "ALA", "A"));
  const std::string hostile = folder.file(
      "#fopen.cif", mmcif("'\"} #fopen F \"x\" write //'", "'*/ #include \"/etc/passwd\"'", "'} #error \"y\" {'"));
  for (const std::string color : {"element", "chain", "residue", "atom"}) {
    for (const auto& [file, scene] : {std::pair(plain, "a"), std::pair(hostile, "b")}) {
      const test::ProgramResult run = test::run_program(
          test::meniscus_program(), {"export", "povray", file, "--device", "cpu", "--color", color, "--force",
                                     "--sticks", "all", "-o", (folder.path() / scene).string()});
      ASSERT_EQ(run.exit_code, 0) << run.err;
    }
    const std::string comment = color == "element" ? "  // element C" : color == "chain" ? "  // chain A" : "";
    const std::string style = test::read_bytes(folder.path() / "a" / "surface_style.inc");
    if (!comment.empty()) {
      EXPECT_NE(style.find(comment + "\n"), std::string::npos) << style.substr(0, 500);
    }
    for (const char* const file : {"surface.ini", "surface.pov", "surface.inc", "surface_style.inc", "surface_aov.inc",
                                   "surface_geometry.inc", "surface_shapes.inc"}) {
      const std::string text = test::read_bytes(folder.path() / "b" / file);
      for (const char* const word : {"#fopen", "passwd", "#error", "write //"})
        EXPECT_EQ(text.find(word), std::string::npos) << word << " in " << file;
      // Residue names choose colours; without them not a byte may differ.
      if (color != "residue") {
        std::string expected = test::read_bytes(folder.path() / "a" / file);
        // A name that might act as code is no comment, either.
        const std::size_t name = color == "chain" ? expected.find(comment) : std::string::npos;
        if (name != std::string::npos) expected.erase(name, comment.size());
        EXPECT_TRUE(expected == text) << file << " by " << color;
      }
    }
  }
}

TEST(PovrayCommand, CommentsNameKindsAndAtomsThatAreHarmless) {
  const test::TemporaryFolder folder;
  const std::string plain = folder.file("plain.cif", mmcif("CA", "ALA", "A"));
  // The names are short enough, so that only their letters are refused.
  const std::string hostile = folder.file("h.cif", mmcif("'{#'", "'*/'", "'\"}'"));
  const auto geometry = [&](const std::string& file, const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "export", "povray", file, "--device", "cpu", "-o", (folder.path() / name).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::ProgramResult run = test::run_program(test::meniscus_program(), arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return test::read_bytes(folder.path() / name / "surface_geometry.inc");
  };
  const auto without = [](std::string text, const std::string& comment) {
    for (std::size_t at = 0; (at = text.find(comment)) != std::string::npos;) text.erase(at, comment.size());
    return text;
  };
  const std::string bare = geometry(plain, "bare", {}), told = geometry(plain, "told", {"--comments"});
  const std::string convex = "// convex A ALA 1 CA\n", toroidal = "// toroidal A ALA 1 CA; A ALA 1 CA\n";
  EXPECT_EQ(bare.find("// convex"), std::string::npos);
  EXPECT_NE(told.find(convex + "sphere{"), std::string::npos);
  EXPECT_NE(told.find(toroidal + "torus{"), std::string::npos);
  EXPECT_EQ(without(without(told, convex), toroidal), bare);
  const std::string unnamed = geometry(hostile, "hostile", {"--comments"});
  EXPECT_EQ(without(without(unnamed, "// convex ?\n"), "// toroidal ?; ?\n"), bare);
}

TEST(PovrayCommand, KeepsWhatExistsAndRefusesNonsense) {
  const test::TemporaryFolder folder;
  const std::string molecule = folder.file("m.cif", mmcif("CA", "ALA", "A"));
  const std::filesystem::path scene = folder.path() / "scene";
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"export", "povray", molecule, "--device", "cpu", "-o", scene.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::run_program(test::meniscus_program(), arguments);
  };
  const test::ProgramResult first = run({});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_NE(first.err.find("7 files"), std::string::npos) << first.err;
  write_text(scene / "surface.pov", "mine");
  EXPECT_EQ(run({}).exit_code, 6);
  EXPECT_EQ(run({"--force", "--size", "0x10"}).exit_code, 2);
  EXPECT_EQ(run({"--force", "--material", "gold"}).exit_code, 2);
  EXPECT_EQ(run({"--force", "--camera", "/nowhere.json"}).exit_code, 3);
  EXPECT_EQ(test::read_bytes(scene / "surface.pov"), "mine");
  EXPECT_EQ(run({"--force", "--projection", "orthographic", "--material", "glass"}).exit_code, 0);
  EXPECT_NE(test::read_bytes(scene / "surface.pov").find("orthographic"), std::string::npos);
}

}  // namespace
}  // namespace meniscus::testing
