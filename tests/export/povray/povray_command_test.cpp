// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export povray` as users meet it, with files that try to write scene code.
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/export/povray/povray_render.h"

namespace meniscus::testing {
namespace {

// Two mmCIF atoms with the given names. Text fields hold anything but newlines.
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

int meniscus_program(const std::string& arguments, std::string* output = nullptr) {
  const ScratchFolder scratch;
  const std::filesystem::path log = scratch.path() / "log";
  const int status = std::system((MENISCUS_PROGRAM " " + arguments + " > '" + log.string() + "' 2>&1").c_str());
  if (output) *output = read_text(log);
  return WEXITSTATUS(status);
}

TEST(PovrayCommand, TextOfAMoleculeNeverReachesTheScene) {
  const ScratchFolder scratch;
  const std::filesystem::path plain = scratch.path() / "plain.cif", hostile = scratch.path() / "#fopen.cif";
  write_text(plain, mmcif("CA", "ALA", "A"));
  write_text(hostile, mmcif("'\"} #fopen F \"x\" write //'", "'*/ #include \"/etc/passwd\"'", "'} #error \"y\" {'"));
  for (const std::string color : {"element", "chain", "residue", "atom"}) {
    std::string log;
    ASSERT_EQ(meniscus_program(fmt::format("export povray '{}' --device cpu --color {} --force -o '{}'", plain.string(),
                                           color, (scratch.path() / "a").string()),
                               &log),
              0)
        << log;
    ASSERT_EQ(meniscus_program(fmt::format("export povray '{}' --device cpu --color {} --force -o '{}'",
                                           hostile.string(), color, (scratch.path() / "b").string()),
                               &log),
              0)
        << log;
    for (const char* const file :
         {"surface.ini", "surface.pov", "surface_style.inc", "surface_aov.inc", "surface_geometry.inc"}) {
      const std::string text = read_text(scratch.path() / "b" / file);
      for (const char* const word : {"#fopen", "passwd", "#error", "write //"})
        EXPECT_EQ(text.find(word), std::string::npos) << word << " in " << file;
      // Residue names choose colours; otherwise not a byte may differ.
      if (color != "residue") EXPECT_TRUE(read_text(scratch.path() / "a" / file) == text) << file << " by " << color;
    }
  }
}

TEST(PovrayCommand, KeepsWhatExistsAndRefusesNonsense) {
  const ScratchFolder scratch;
  const std::filesystem::path molecule = scratch.path() / "m.cif", folder = scratch.path() / "scene";
  write_text(molecule, mmcif("CA", "ALA", "A"));
  const std::string command =
      fmt::format("export povray '{}' --device cpu -o '{}'", molecule.string(), folder.string());
  std::string log;
  ASSERT_EQ(meniscus_program(command, &log), 0) << log;
  EXPECT_NE(log.find("5 files"), std::string::npos) << log;
  write_text(folder / "surface.pov", "mine");
  EXPECT_EQ(meniscus_program(command, &log), 6);
  EXPECT_EQ(read_text(folder / "surface.pov"), "mine");
  EXPECT_EQ(meniscus_program(command + " --force --size 0x10", &log), 2) << log;
  EXPECT_EQ(meniscus_program(command + " --force --material gold", &log), 2) << log;
  EXPECT_EQ(meniscus_program(command + " --force --camera /nowhere.json", &log), 3) << log;
  EXPECT_EQ(read_text(folder / "surface.pov"), "mine");
  EXPECT_EQ(meniscus_program(command + " --force --projection orthographic --material glass", &log), 0) << log;
  EXPECT_NE(read_text(folder / "surface.pov").find("orthographic"), std::string::npos);
}

}  // namespace
}  // namespace meniscus::testing
