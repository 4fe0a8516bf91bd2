// SPDX-License-Identifier: BSD-3-Clause
// Topologies: PSF in its forms, and the bonds of PSF and of PDB's CONECT records.
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/structure/formats/read_structure.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

using test::TemporaryFolder;

const std::string kTail = "\n       2 !NBOND: bonds\n       1       2       1       3\n\n       0 !NTHETA: angles\n\n";

std::string psf(const std::string& first_line, const std::string& atoms, const std::string& tail = kTail) {
  return first_line + "\n\n       1 !NTITLE\n REMARKS atoms !NATOM\n\n       3 !NATOM\n" + atoms + tail;
}

const std::string kAtoms =
    "       1 A    7    MET  N     NH3   -0.300000       14.0070           0\n"
    "       2 A    8A   CAL  CAL    56    2.000000       40.0800           0   0.00000     -0.301140E-02\n"
    "       3 B    -1   LYS  HZ1   HC     0.330000E+00   3.02400           0\n";

Structure read(const std::string& text, bool place = true) {
  const TemporaryFolder folder;
  ReadOptions options;
  options.keep_topology = options.keep_ions = true;
  if (place) options.positions = {{0, 0, 0}, {5, 0, 0}, {0, 5, 0}};
  return read_structure(folder.file("a.psf", text), options);
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

void expect_three_atoms(const Structure& structure) {
  ASSERT_EQ(structure.atoms.size(), 3U);
  const auto& atoms = structure.atoms;
  EXPECT_EQ(structure.format, "PSF");
  EXPECT_EQ(atoms[0].element, 7);
  EXPECT_EQ(atoms[1].element, 20);
  EXPECT_EQ(atoms[2].element, 1);  // Hydrogen has three times its weight, as in runs with a long time step.
  EXPECT_EQ(atoms[0].residue_number, 7);
  EXPECT_EQ(atoms[1].residue_number, 8);
  EXPECT_EQ(atoms[1].insertion_code, 'A');
  EXPECT_EQ(atoms[2].residue_number, -1);
  EXPECT_EQ(atoms[0].name, "N");
  EXPECT_EQ(atoms[1].kind, AtomClass::ion);
  EXPECT_FLOAT_EQ(atoms[2].charge, 0.33F);
  EXPECT_EQ(atoms[1].position, glm::dvec3(5, 0, 0));
  EXPECT_EQ(structure.topology->bonds, (std::vector<Bond>{{0, 1}, {0, 2}}));
}

TEST(Psf, StandardExtendedAndNamdForms) {
  const Structure standard = read(psf("PSF CMAP CHEQ", kAtoms));
  expect_three_atoms(standard);
  EXPECT_EQ(standard.atoms[2].chain, "B");
  EXPECT_EQ(standard.atoms[2].segment, "B");
  expect_three_atoms(
      read(psf("PSF EXT CMAP XPLOR",
               "         1 PROTEIN1 7        MET      N        NH3    -0.300000       14.0070           0\n"
               "         2 PROTEIN1 8A       CAL      CAL      CAL     2.000000       40.0800           0\n"
               "         3 PROTEIN1 -1       LYS      HZ1      HC      0.330000       3.02400           0\n",
               "\n         2 !NBOND: bonds\n         1         2         1         3\n")));
  expect_three_atoms(read(psf("PSF NAMD",
                              "1 A 7 MET N NH3 -0.3 14.007 0\n2 A 8A CAL CAL CAL 2 40.08 0\n"
                              "3 B -1 LYS HZ1 HC .33 3.024 0\n")));
  const Structure blank = read(psf("PSF",
                                   "       1      7    MET  N     NH3   -0.300000       14.0070           0\n"
                                   "       2      8A   CAL  CAL   CAL    2.000000       40.0800           0\n"
                                   "       3      -1   LYS  HZ1   HC     0.330000       3.02400           0\n"));
  expect_three_atoms(blank);
  EXPECT_EQ(blank.atoms[0].chain, "");
  const Structure typeless = read(psf("PSF",  // ProDy writes this form.
                                      "       1 A    7    MET  N          -0.300000       14.0070       0\n"
                                      "       2 A    8A   CAL  CAL         2.000000       40.0800       0\n"
                                      "       3 B    -1   LYS  HZ1         0.330000        3.0240       0\n"));
  expect_three_atoms(typeless);
  EXPECT_EQ(typeless.atoms[2].chain, "B");
  const Structure both = read(psf("PSF",  // MDAnalysis and VMD read this form by its columns.
                                  "       1      7    MET  N              -0.300000       14.0070       0\n"
                                  "       2      8A   CAL  CAL             2.000000       40.0800       0\n"
                                  "       3      -1   LYS  HZ1             0.330000        3.0240       0\n"));
  expect_three_atoms(both);
  EXPECT_EQ(both.atoms[2].chain, "");
  expect_three_atoms(
      read(psf("PSF EXT",
               "         1          7        MET      N               -0.300000       14.0070           0\n"
               "         2          8A       CAL      CAL              2.000000       40.0800           0\n"
               "         3          -1       LYS      HZ1              0.330000       3.02400           0\n",
               "\n         2 !NBOND: bonds\n         1         2         1         3\n")));
}

TEST(Psf, MassMovedToHydrogensLeavesElementsAsNamed) {
  const Structure structure = read(psf("PSF",
                                       "1 A 1 ALA N NH1 -0.3 11.991 0\n"  // The atom is as heavy as carbon.
                                       "2 A 1 ALA CA CT1 0.1 9.995 0\n3 A 1 ALA HN H 0.3 4.0 0\n"));
  EXPECT_EQ(structure.atoms[0].element, 7);
  EXPECT_EQ(structure.atoms[1].element, 6);
  EXPECT_EQ(structure.atoms[2].element, 1);
}

TEST(Psf, NumbersOfBondsMayTouch) {
  const std::string ends = "\n         2 !NBOND: bonds\n000000000100000000020000000001" + std::string("0000000003\n");
  EXPECT_EQ(read(psf("PSF EXT", kAtoms, ends)).topology->bonds, (std::vector<Bond>{{0, 1}, {0, 2}}));
}

TEST(Psf, DamageIsNamedWithItsLine) {
  const std::string whole = psf("PSF", kAtoms);
  const auto expect = [](const std::string& text, const std::string& words) {
    EXPECT_NE(refusal(text).find(words), std::string::npos) << refusal(text);
  };
  expect(whole.substr(0, whole.find("       3 B")), "a.psf:6: the count says 3 atoms, but the file ends after 2");
  const Structure bare = read(whole.substr(0, whole.find("2 !NBOND")));
  EXPECT_EQ(bare.atoms.size(), 3u);
  EXPECT_EQ(bare.report.warnings.front().text,
            "it has no section !NBOND, so its bonds are unknown; is the file cut short?");
  expect("PSF\n\n 1 !NTITLE\n", "has no line with a number and !NATOM; is the file cut short?");
  expect(psf("PSF", kAtoms, "\n 2 !NBOND: bonds\n 1 2\n"), "!NBOND says 2 bonds, but 1 follow; is the file cut short?");
  expect(psf("PSF", kAtoms, "\n 2 !NBOND: bonds\n 1 2\n\n 9 !NTHETA\n"), "!NBOND says 2 bonds, but 1 follow");
  expect(psf("PSF", kAtoms, "\n 1 !NBOND: bonds\n 1 4\n"), "a bond names atom '4'; the atoms are 1 to 3");
  expect("PSF\n\n 99999999 !NATOM\n", "more than the 0 bytes after it can hold");
  expect("PSF\n\n -3 !NATOM\n", "!NATOM says -3");
  expect(psf("PSF", kAtoms.substr(0, 30) + "\n" + kAtoms), "is not an atom: number, segment");
  try {
    read(whole, false);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("without coordinates; add --trajectory"), std::string::npos);
  }
}

std::string pdb_atom(const std::string& serial, double x) {
  return fmt::format("HETATM{:>5} C1   LIG A   1    {:8.3f}{:8.3f}{:8.3f}  1.00  0.00           C\n", serial, x, 0.0,
                     0.0);
}

std::vector<Bond> bonds_of(const std::string& text) {
  const TemporaryFolder folder;
  ReadOptions options;
  options.keep_topology = true;
  return read_structure(folder.file("a.pdb", text), options).topology->bonds;
}

TEST(Conect, NumbersOfEveryKindNameAtoms) {
  EXPECT_EQ(bonds_of(pdb_atom("1", 0) + pdb_atom("A0000", 2) + pdb_atom("186a1", 4) + pdb_atom("7", 6) +
                     "CONECT    1A0000    7    7\nCONECTA0000    1186a1\nCONECT    9    1\nCONECT    7    7\n"),
            (std::vector<Bond>{{0, 1}, {0, 3}, {1, 2}}));
}

TEST(Conect, NumbersThatSeveralAtomsBearNameNone) {
  EXPECT_EQ(bonds_of(pdb_atom("*****", 0) + pdb_atom("*****", 2) + pdb_atom("3", 4) + "CONECT    3*****\n"),
            std::vector<Bond>());
  const std::string model = pdb_atom("1", 0) + pdb_atom("2", 2);
  EXPECT_EQ(bonds_of("MODEL        1\n" + model + "ENDMDL\nMODEL        2\n" + model + "ENDMDL\nCONECT    1    2\n"),
            (std::vector<Bond>{{0, 1}}));
}

}  // namespace
}  // namespace meniscus
