// SPDX-License-Identifier: BSD-3-Clause
// Chemical components as the wwPDB's dictionary and restraint dictionaries write them: coordinates and bonds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/structure/formats/read_structure.h"
#include "tests/support/binary_cif.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

/// Returns one atom with model coordinates, which may be "? ? ?", and ideal ones.
std::string row(const char* component, const char* name, const char* model, const char* ideal, int charge = 0) {
  return fmt::format("{} \"{}\" {} {} {} {}\n", component, name, name[0], charge, model, ideal);
}

std::string component(const std::string& id, const std::string& rows, const std::string& bonds) {
  std::string text = fmt::format("data_{}\n_chem_comp.id {}\nloop_\n", id, id);
  for (const char* column :
       {"comp_id", "atom_id", "type_symbol", "charge", "model_Cartn_x", "model_Cartn_y", "model_Cartn_z",
        "pdbx_model_Cartn_x_ideal", "pdbx_model_Cartn_y_ideal", "pdbx_model_Cartn_z_ideal"})
    text += fmt::format("_chem_comp_atom.{}\n", column);
  return text + rows + "loop_\n_chem_comp_bond.comp_id\n_chem_comp_bond.atom_id_1\n_chem_comp_bond.atom_id_2\n" + bonds;
}

const std::string kWhole =
                      component("CYN", row("CYN", "C", "1 2 3", "0 0 0", -1) + row("CYN", "N'", "2.1 2 3", "1.1 0 0"),
                                "CYN C \"N'\"\n"),
                  kIdeal = component("CMO", row("CMO", "C", "1 2 3", "0 0 0") + row("CMO", "O", "? ? ?", "1.1 0 0"),
                                     "CMO O C\n");

Structure read(const std::string& text, const char* model = "1") {
  const test::TemporaryFolder folder;
  ReadOptions options;
  options.keep_topology = true;
  options.model.all = std::string(model) == "all";
  if (!options.model.all) options.model.number = std::stoi(model);
  return read_structure(folder.file("a.cif", text), options);
}

std::string said(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ChemicalComponents, ModelCoordinatesWithBonds) {
  const Structure structure = read(kWhole);
  ASSERT_EQ(structure.atoms.size(), 2u);
  EXPECT_EQ(structure.atoms[1].position, glm::dvec3(2.1, 2, 3));
  EXPECT_EQ(structure.atoms[1].name, "N'");
  EXPECT_EQ(structure.atoms[1].element, 7);
  EXPECT_EQ(structure.atoms[0].residue_name, "CYN");
  EXPECT_EQ(structure.atoms[0].kind, AtomClass::ligand);
  EXPECT_EQ(structure.topology->bonds, (std::vector<Bond>{{0, 1}}));
  ASSERT_EQ(structure.report.warnings.size(), 1u);
  EXPECT_EQ(structure.report.warnings[0].text, "model coordinates of component 'CYN' are used");
}

TEST(ChemicalComponents, IdealCoordinatesWhereTheModelIsNotWhole) {
  const Structure structure = read(kIdeal);
  EXPECT_EQ(structure.atoms[1].position, glm::dvec3(1.1, 0, 0));
  EXPECT_EQ(structure.report.warnings[0].text, "ideal coordinates of component 'CMO' are used");
  const std::string none =
      component("CMO", row("CMO", "C", "1 2 3", "? 0 0") + row("CMO", "O", "? ? ?", "1.1 0 0"), "CMO O C\n");
  EXPECT_NE(said(none).find("component 'CMO' has neither model nor ideal coordinates of all of its 2 atoms"),
            std::string::npos);
}

TEST(ChemicalComponents, EachIsAModel) {
  const Structure second = read(kWhole + kIdeal, "2");
  EXPECT_EQ(second.report.models, 2u);
  EXPECT_EQ(second.atoms[0].residue_name, "CMO");
  EXPECT_EQ(second.report.excluded.at(kExcludedModel), 2u);
  EXPECT_EQ(read(kWhole + kIdeal).report.warnings.size(), 2u);  // another component, and the coordinates
  const Structure all = read(kWhole + kIdeal, "all");
  EXPECT_EQ(all.atoms.size(), 4u);
  EXPECT_EQ(all.topology->bonds, (std::vector<Bond>{{0, 1}, {2, 3}}));
}

TEST(ChemicalComponents, RestraintDictionariesAndOtherBonds) {
  const std::string atoms =
      "data_comp_X\nloop_\n_chem_comp_atom.comp_id\n_chem_comp_atom.atom_id\n"
      "_chem_comp_atom.type_symbol\n_chem_comp_atom.x\n_chem_comp_atom.y\n_chem_comp_atom.z\n";
  const Structure structure = read(atoms + "X C1 C 1.5 0 0\nX CL CL 3.2 0 0\n");
  EXPECT_EQ(structure.atoms[1].element, 17);
  EXPECT_EQ(structure.report.warnings[0].text, "dictionary coordinates of component 'X' are used");
  EXPECT_NE(said(atoms + "X C1 C x 0 0\n").find("coordinate x is 'x'"), std::string::npos);
  EXPECT_TRUE(read(component("A", row("A", "C", "0 0 0", "0 0 0"), "A C N\n")).topology->bonds.empty());
  EXPECT_NE(said("data_X\n_chem_comp.id X\n").find("has no table _atom_site"), std::string::npos);
}

TEST(ChemicalComponents, FromBinaryCif) {
  const test::TemporaryFolder folder;
  const auto column = [](const char* name, const test::Json& values) { return test::column(name, values); };
  const test::Json ids = test::strings("CYN", {0, 3}, {0, 0}), names = test::strings("CN", {0, 1, 2}, {0, 1});
  const std::string bytes = test::binary_cif(
      {test::category("_chem_comp_atom", 2,
                      {column("comp_id", ids), column("atom_id", names), column("type_symbol", names),
                       column("x", test::data<float>({0.5F, 1.5F}, 32)), column("y", test::data<float>({0, 0}, 32)),
                       column("z", test::data<float>({0, 0}, 32))})});
  const Structure structure = read_structure(folder.file("a.bcif", bytes));
  ASSERT_EQ(structure.atoms.size(), 2u);
  EXPECT_EQ(structure.atoms[1].position, glm::dvec3(1.5, 0, 0));
}

}  // namespace
}  // namespace meniscus
