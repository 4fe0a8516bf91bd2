// SPDX-License-Identifier: BSD-3-Clause
// Incomplete alternate locations, the greatest areas of amino acids, and residues that have a relative area.
#include "core/structure/residues.h"

#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/structure/element_tables.h"
#include "core/structure/formats/read_structure.h"
#include "core/structure/structure.h"
#include "tests/support/run_program.h"

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
    double relative;  // relative area at 1 Å² per atom; -1: none
  } residues[] = {{"ALA", "N CA C O CB", 5.0 / 129},
                  {"ALA", "N CA C O CB OXT", 6.0 / 129},
                  {"ALA", "N H CA HA C O CB HB1 HB2 HB3", 10.0 / 129},
                  {"ALA", "N CA C OT1 OT2 CB", 6.0 / 129},
                  {"GLY", "N CA C O", 4.0 / 104},
                  {"ILE", "N CA C O CB CG1 CG2 CD", 8.0 / 197},  // GROMACS' name
                  {"MSE", "N CA C O CB CG SE CE", 8.0 / 224},
                  {"ALA", "N CA C O", -1},  // The side chain is missing.
                  {"LYS", "N CA C O CB", -1},
                  {"ALA", "N CA C O O O", -1},  // The number is right, but the atoms are wrong.
                  {"ALA", "CA", -1},
                  {"ALA", "BB SC1", -1},  // beads of Martini
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

struct AtomRow {
  const char *name, *element;
  char altloc;
  double occupancy, x, y, z;
  const char* residue = "SER";
};

std::string pdb_of(const std::vector<AtomRow>& rows) {
  std::string text;
  for (const AtomRow& r : rows)
    text += fmt::format("ATOM      1 {:<4}{}{:>3} A   2    {:8.3f}{:8.3f}{:8.3f}{:6.2f} 10.00          {:>2}\n", r.name,
                        r.altloc, r.residue, r.x, r.y, r.z, r.occupancy, r.element);
  return text;
}

std::string mmcif_of(const std::vector<AtomRow>& rows) {
  std::string text = "data_a\nloop_\n";
  for (const char* column : {"type_symbol", "label_atom_id", "label_alt_id", "label_comp_id", "label_asym_id",
                             "label_seq_id", "Cartn_x", "Cartn_y", "Cartn_z", "occupancy", "B_iso_or_equiv"})
    text += fmt::format("_atom_site.{}\n", column);
  for (const AtomRow& r : rows)
    text += fmt::format("{} {} {} {} A 2 {:.3f} {:.3f} {:.3f} {:.2f} 10.00\n", r.element, r.name,
                        r.altloc == ' ' ? '.' : r.altloc, r.residue, r.x, r.y, r.z, r.occupancy);
  return text;
}

/// Returns the kept atoms, "N.A" of alternate location A, in the order of the file; both formats must agree.
std::vector<std::string> kept_of(const std::vector<AtomRow>& rows, const char* choice = "best",
                                 std::vector<Warning>* warnings = nullptr) {
  const test::TemporaryFolder folder;
  ReadOptions options;
  options.altloc = parse_altloc_choice(choice).value();
  std::vector<std::vector<std::string>> names;
  for (const auto& [name, text] : {std::pair("a.pdb", pdb_of(rows)), std::pair("a.cif", mmcif_of(rows))}) {
    const Structure structure = read_structure(folder.file(name, text), options);
    names.emplace_back();
    for (const Atom& atom : structure.atoms)
      names.back().push_back(atom.altloc == ' ' ? atom.name : atom.name + '.' + atom.altloc);
    if (warnings) *warnings = structure.report.warnings;
  }
  EXPECT_EQ(names[0], names[1]);
  return names[0];
}

using Names = std::vector<std::string>;

/// A is whole, B is the most occupied, C is as short as B: SER 437 of the entry 5U3A.
const std::vector<AtomRow> kSerine{{"N", "N", 'A', 0.30, 0, 0, 0},
                                   {"CA", "C", 'A', 0.30, 1.46, 0, 0},
                                   {"C", "C", 'A', 0.30, 2.0, 1.42, 0},
                                   {"O", "O", 'A', 0.30, 1.25, 2.39, 0},
                                   {"CB", "C", 'A', 0.30, 1.99, -.77, -1.21},
                                   {"OG", "O", 'A', 0.30, 1.57, -.22, -2.45},
                                   {"CB", "C", 'B', 0.45, 1.99, -.77, -1.11},
                                   {"OG", "O", 'B', 0.45, 2.47, .68, -2.15},
                                   {"CB", "C", 'C', 0.25, 1.99, -.67, -1.11},
                                   {"OG", "O", 'C', 0.25, .67, -1.12, -2.15}};

TEST(Altloc, AResidueIsCompletedByName) {
  std::vector<Warning> warnings;
  EXPECT_EQ(kept_of(kSerine, "best", &warnings), (Names{"N.A", "CA.A", "C.A", "O.A", "CB.B", "OG.B"}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(
      warnings.front().text,
      "1 residue has atoms that the chosen alternate location lacks; they are taken from the next (first: SER A2: "
      "N CA C O of A beside B)");
  EXPECT_EQ(kept_of(kSerine, "C"), (Names{"N.A", "CA.A", "C.A", "O.A", "CB.C", "OG.C"}));
  EXPECT_EQ(kept_of(kSerine, "A", &warnings), (Names{"N.A", "CA.A", "C.A", "O.A", "CB.A", "OG.A"}));
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(kept_of(kSerine, "all").size(), kSerine.size());
}

TEST(Altloc, TheNextIsTheMostOccupiedThenTheFirstOfTheFile) {
  const std::vector<AtomRow> rows{
      {"N", "N", ' ', 1, 0, 0, 0},       {"CA", "C", 'A', 0.2, 1.5, 0, 0}, {"CB", "C", 'A', 0.2, 2, 1.4, 0},
      {"CA", "C", 'C', 0.3, 1.5, .1, 0}, {"CB", "C", 'C', 0.3, 2, 1.5, 0}, {"OG", "O", 'C', 0.3, 3, 2.3, 0},
      {"CB", "C", 'B', 0.3, 2, 1.6, 0},  {"OG", "O", 'B', 0.3, 3, 2.4, 0}, {"CA", "C", 'D', 0.4, 1.5, .2, 0}};
  EXPECT_EQ(kept_of(rows), (Names{"N", "CB.C", "OG.C", "CA.D"}));
}

TEST(Altloc, ResiduesOfOtherNamesGiveNothing) {
  const std::vector<AtomRow> rows{{"CB", "C", 'A', 0.4, 0, 0, 0, "SER"},
                                  {"OG", "O", 'A', 0.4, 1.4, 0, 0, "SER"},
                                  {"CB", "C", 'B', 0.6, 0, 0, 0, "ALA"}};
  std::vector<Warning> warnings;
  EXPECT_EQ(kept_of(rows, "best", &warnings), (Names{"CB.B"}));
  EXPECT_TRUE(warnings.empty());
}

TEST(Altloc, HydrogensComeWithTheAtomThatTheyAreBondedTo) {
  // In neutron data H and D share a place; in another conformer hydrogens have other places about the same carbon.
  const std::vector<AtomRow> exchanged{
      {"N", "N", ' ', 1, 0, 0, 0}, {"H", "H", 'A', 0.4, 1, 0, 0}, {"D", "D", 'B', 0.6, 1, 0, 0}};
  EXPECT_EQ(kept_of(exchanged), (Names{"N", "D.B"}));
  const std::vector<AtomRow> turned{{"CB", "C", 'A', 0.4, 0, 0, 0},    {"HB1", "H", 'A', 0.4, 1, 0, 0},
                                    {"OG", "O", 'A', 0.4, -1.4, 0, 0}, {"HG", "H", 'A', 0.4, -2, .7, 0},
                                    {"CB", "C", 'B', 0.6, 0, 0, .5},   {"HB2", "H", 'B', 0.6, 0, 1, .5}};
  EXPECT_EQ(kept_of(turned), (Names{"OG.A", "HG.A", "CB.B", "HB2.B"}));
}

TEST(Altloc, BondsJoinWhatCompletesAResidue) {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("a.pdb", pdb_of(kSerine));
  ReadOptions options;
  options.shown.push_back({"sticks", parse_selection("all")});
  const Structure mixed = read_structure(path, options);
  std::set<std::pair<std::string, std::string>> joined;
  for (const auto& [a, b] : *mixed.shown_bonds) joined.insert({mixed.atoms[a].name, mixed.atoms[b].name});
  EXPECT_EQ(joined, (std::set<std::pair<std::string, std::string>>{
                        {"N", "CA"}, {"CA", "C"}, {"C", "O"}, {"CA", "CB"}, {"CB", "OG"}}));
  options.altloc.rule = AltlocChoice::Rule::all;
  const Structure all = read_structure(path, options);
  for (const auto& [a, b] : *all.shown_bonds) EXPECT_EQ(all.atoms[a].altloc, all.atoms[b].altloc);
}

}  // namespace
}  // namespace meniscus
