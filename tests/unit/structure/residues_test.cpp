// SPDX-License-Identifier: BSD-3-Clause
// The greatest areas of amino acids against other people's copies of the table, and which residues have a relative one.
#include "core/structure/residues.h"

#include <cmath>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "core/structure/element_tables.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

TEST(Accessibility, GreatestAreasAreThoseOfThePaper) {
  // Biopython 1.88, Bio.Data.PDBData.residue_sasa_scales["Wilke"]; the column "Theoretical" of the paper's table 1.
  std::istringstream table(
      "ALA 129 ARG 274 ASN 195 ASP 193 CYS 167 GLN 225 GLU 223 GLY 104 HIS 224 ILE 197 LEU 201 LYS 236 MET 224 PHE 240 "
      "PRO 159 SER 155 THR 172 TRP 285 TYR 263 VAL 174");
  std::string residue;
  int count = 0;
  for (double area = 0.0; table >> residue >> area; ++count) EXPECT_EQ(greatest_accessible_area(residue), area);
  EXPECT_EQ(count, 20);
  for (const auto& [name, as] :
       {std::pair{"HIE", "HIS"}, {"HSP", "HIS"}, {"CYX", "CYS"}, {"GLH", "GLU"}, {"MSE", "MET"}})
    EXPECT_EQ(greatest_accessible_area(name), greatest_accessible_area(as)) << name;
  for (const char* name : {"", "ACE", "DA", "HOH", "HEM", "UNK", "SEP"})
    EXPECT_TRUE(std::isnan(greatest_accessible_area(name))) << name;
}

TEST(Accessibility, IsThatOfWholeResidues) {
  const struct {
    const char *residue, *atoms;
    double relative;  // of one Å² an atom; -1: none
  } residues[] = {{"ALA", "N CA C O CB", 5.0 / 129},
                  {"ALA", "N CA C O CB OXT", 6.0 / 129},
                  {"ALA", "N H CA HA C O CB HB1 HB2 HB3", 10.0 / 129},
                  {"ALA", "N CA C OT1 OT2 CB", 6.0 / 129},
                  {"GLY", "N CA C O", 4.0 / 104},
                  {"ILE", "N CA C O CB CG1 CG2 CD", 8.0 / 197},  // GROMACS' name
                  {"MSE", "N CA C O CB CG SE CE", 8.0 / 224},
                  {"ALA", "N CA C O", -1},  // a side chain that is not there
                  {"LYS", "N CA C O CB", -1},
                  {"ALA", "N CA C O O O", -1},  // as many, but not the right ones
                  {"ALA", "CA", -1},
                  {"ALA", "BB SC1", -1},  // of Martini
                  {"HEM", "FE NA NB", -1}};
  Structure structure;
  for (const auto& [residue, atoms, relative] : residues) {
    std::istringstream names(atoms);
    const std::uint32_t number = structure.atoms.empty() ? 0 : structure.atoms.back().residue + 1;
    for (std::string name; names >> name;) {
      Atom& atom = structure.atoms.emplace_back();
      atom.residue = number;
      atom.residue_name = residue;
      atom.name = name;
    }
  }
  const std::vector<double> found = relative_accessibility(structure, std::vector<double>(structure.atoms.size(), 1.0));
  ASSERT_EQ(found.size(), structure.atoms.size());
  for (std::size_t a = 0; a < found.size(); ++a) {
    const auto& row = residues[structure.atoms[a].residue];
    if (row.relative < 0)
      EXPECT_TRUE(std::isnan(found[a])) << row.residue << " " << row.atoms;
    else
      EXPECT_NEAR(found[a], row.relative, 1e-12) << row.residue << " " << row.atoms;
  }
  EXPECT_TRUE(relative_accessibility({}, {}).empty());
}

}  // namespace
}  // namespace meniscus
