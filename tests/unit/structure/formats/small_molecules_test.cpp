// SPDX-License-Identifier: BSD-3-Clause
// SDF, MOL2 and PDBQT: contents of good and odd files, and messages about bad ones.
#include "core/structure/formats/read_structure.h"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

using test::TemporaryFolder;

/// Reads all atoms of the file, also those of water and ions.
FileContents contents_of(const std::string& name, const std::string& text, const ModelChoice& models = {}) {
  const TextFile file = text_of_bytes(name, text);
  return choose_reader(file).read(file, models);
}

Structure read_text(const std::string& name, const std::string& text, const ReadOptions& options = {}) {
  const TemporaryFolder folder;
  return read_structure(folder.file(name, text), options);
}

void expect_refused(const std::string& name, const std::string& text, const std::string& message) {
  try {
    contents_of(name, text);
    ADD_FAILURE() << "no error: " << message;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
  }
}

std::string with(std::string text, const std::string& old, const std::string& other) {
  EXPECT_NE(text.find(old), std::string::npos) << old;
  return text.replace(text.find(old), old.size(), other);
}

const std::string kAcetate =
    "acetate ion\n  test    01012600003D\n\n"
    "  4  3  0  0  0  0  0  0  0  0999 V2000\n"
    "    0.0000    0.0000    0.0000 C   0  0\n"
    "    1.5000    0.0000    0.5000 C   0  0\n"
    "    2.1000    1.1000    0.5000 O   0  0\n"
    "   -2.1000   -1.1000    0.7000 O   0  5\n"
    "  1  2  1  0\n"
    "  2  3  2  0\n"
    "  2  4  1  0\n"
    "M  END\n";

TEST(Sdf, AtomsBondsAndChargesOfALigand) {
  const Structure structure = read_text("a.mol", kAcetate);
  EXPECT_EQ(structure.format, "SDF");
  ASSERT_EQ(structure.atoms.size(), 4u);
  const char* names[] = {"C1", "C2", "O1", "O2"};
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_EQ(structure.atoms[n].name, names[n]);
    EXPECT_EQ(structure.atoms[n].kind, AtomClass::ligand);
    EXPECT_EQ(structure.atoms[n].residue_name, "acetate");
  }
  EXPECT_EQ(structure.atoms[3].position, glm::dvec3(-2.1, -1.1, 0.7));
  EXPECT_EQ(structure.atoms[3].element, 8);
  EXPECT_EQ(structure.atoms[3].charge, -1.0F);
  EXPECT_EQ(structure.atoms[0].charge, 0.0F);
  const FileContents contents = contents_of("a.mol", kAcetate);
  EXPECT_EQ(contents.bonds, (std::vector<Bond>{{0, 1}, {1, 2}, {1, 3}}));
  EXPECT_TRUE(contents.warnings.empty());
}

TEST(Sdf, SticksHaveTheBondsOfTheFileAlone) {
  // O2 is 3.8 Å from C2, but bonded; H is 1 Å from C1, and is not.
  ReadOptions options;
  options.shown.push_back({"sticks", parse_selection("all")});
  const std::string text =
      with(with(kAcetate, "  4  3", "  5  3"), "  1  2  1", "    0.0000    1.0000    0.0000 H   0  0\n  1  2  1");
  EXPECT_EQ(*read_text("a.sdf", text, options).shown_bonds, (std::vector<Bond>{{0, 1}, {1, 2}, {1, 3}}));
}

TEST(Sdf, AddedToAProteinItsBondsStayItsOwn) {
  const TemporaryFolder folder;
  const std::string ligand =
      folder.file("a.sdf", with(with(kAcetate, "  4  3", "  4  1"), "  2  3  2  0\n  2  4  1  0\n", ""));
  const std::string protein =
      folder.file("b.pdb",
                  "ATOM      1  CA  ALA A   1      17.047  14.099   3.625  1.00 10.00           C  \n"
                  "ATOM      2  CB  ALA A   1      18.547  14.099   3.625  1.00 10.00           C  \n");
  ReadOptions options;
  options.shown.push_back({"sticks", parse_selection("all")});
  for (const auto& [first, second] : {std::pair(ligand, protein), std::pair(protein, ligand)}) {
    options.added = {second};
    EXPECT_EQ(read_structure(first, options).shown_bonds->size(), 2u) << first << ": one of each, none by distance";
  }
}

TEST(Sdf, ChargesOfPropertiesStandForThoseOfAtoms) {
  const std::string text = with(kAcetate, "M  END", "M  CHG  2   1   2   3  -1\nM  END");
  const FileContents contents = contents_of("a.sdf", text);
  EXPECT_EQ(contents.atoms[0].charge, 2.0F);
  EXPECT_EQ(contents.atoms[2].charge, -1.0F);
  EXPECT_EQ(contents.atoms[3].charge, 0.0F);
  EXPECT_TRUE(std::isnan(contents_of("a.sdf", with(kAcetate, "O   0  5", "O   0  0")).atoms[3].charge))
      << "none stated";
}

TEST(Sdf, PartialChargesOfPubchemAndRdkit) {
  const FileContents pubchem =
      contents_of("a.sdf", kAcetate + "> <PUBCHEM_MMFF94_PARTIAL_CHARGES>\n2\n1 -0.25\n4 0.5\n\n$$$$\n");
  EXPECT_EQ(pubchem.atoms[0].charge, -0.25F);
  EXPECT_EQ(pubchem.atoms[1].charge, 0.0F);
  EXPECT_EQ(pubchem.atoms[3].charge, 0.5F);
  const FileContents rdkit =
      contents_of("a.sdf", kAcetate + ">  <atom.dprop.PartialCharge>  (1) \n0.1 0.2\n0.3 -0.6\n\n$$$$\n");
  EXPECT_EQ(rdkit.atoms[3].charge, -0.6F);
}

TEST(Sdf, MoleculesAreModels) {
  const std::string two = kAcetate + "> <name>\nfirst\n\n$$$$\n" + with(kAcetate, "acetate ion", "") + "$$$$\n\n";
  const Structure first = read_text("a.sdf", two);
  EXPECT_EQ(first.report.sentence(), "8 atoms read; 4 in other models left out; 4 used");
  ASSERT_EQ(first.report.warnings.size(), 1u);
  EXPECT_EQ(first.report.warnings[0].text,
            "2 molecules are in the file; the first is used, --model 2 takes the next, --model all unites them");
  ReadOptions second;
  second.model.number = 2;
  EXPECT_EQ(read_text("a.sdf", two, second).atoms.at(0).residue_name, "UNL");
  const FileContents all = contents_of("a.sdf", two, {1, true});
  EXPECT_EQ(all.atoms.size(), 8u);
  EXPECT_EQ(all.atoms[7].residue, 1u);
  EXPECT_EQ(all.atoms[7].name, "O2");
  EXPECT_EQ(all.bonds.back(), (Bond{5, 7}));
  EXPECT_TRUE(all.warnings.empty());
}

TEST(Sdf, LonePairsAreLeftOut) {
  const Structure structure = read_text("a.mol", with(kAcetate, "0.5000 O ", "0.5000 Lp"));
  EXPECT_EQ(structure.report.sentence(), "4 atoms read; 1 virtual site left out; 3 used");
}

TEST(Sdf, DrawingsAreWarnedAbout) {
  std::string flat = with(with(kAcetate, "0.5000 C", "0.0000 C"), "0.5000 O", "0.0000 O");
  flat = with(flat, "0.7000 O", "0.0000 O");
  EXPECT_TRUE(contents_of("a.sdf", flat).warnings.empty()) << "its header says 3D";
  const FileContents drawing = contents_of("a.sdf", with(flat, "3D", "2D"));
  ASSERT_EQ(drawing.warnings.size(), 1u);
  EXPECT_EQ(drawing.warnings[0].text,
            "molecule 1 is a drawing in two dimensions (all z are 0); a surface needs coordinates in three");
}

const std::string kV3000 =
    "ethanolate\n\n\n"
    "  0  0  0     0  0            999 V3000\n"
    "M  V30 BEGIN CTAB\nM  V30 COUNTS 3 2 0 0 0\nM  V30 BEGIN ATOM\n"
    "M  V30 10 C 0 0 1 0\nM  V30 20 C 1.5 0 -\nM  V30 0 0\nM  V30 7 O 2.1 1.1 0 0 CHG=-1 MASS=18\n"
    "M  V30 END ATOM\nM  V30 BEGIN BOND\nM  V30 1 1 10 20\nM  V30 2 1 7 20\nM  V30 END BOND\nM  V30 END CTAB\nM  END\n";

TEST(Sdf, V3000NumbersItsAtomsAsItLikes) {
  const FileContents contents = contents_of("a.sdf", kV3000 + "$$$$\n" + kAcetate);
  ASSERT_EQ(contents.atoms.size(), 3u);
  EXPECT_EQ(contents.other_model_atoms, 4u);
  EXPECT_EQ(contents.atoms[1].position, glm::dvec3(1.5, 0, 0));
  EXPECT_EQ(contents.atoms[2].charge, -1.0F);
  EXPECT_EQ(contents.bonds, (std::vector<Bond>{{0, 1}, {1, 2}}));
}

TEST(Sdf, IsToldByContent) {
  EXPECT_EQ(read_text("a", kAcetate).format, "SDF");
  EXPECT_EQ(read_text("a", kV3000).format, "SDF");
  EXPECT_EQ(read_text("a.txt", with(kAcetate, "0999 V2000", "")).format, "SDF") << "before there were versions";
  EXPECT_EQ(read_text("a.sdf", with(kAcetate, "acetate ion", "<0>")).format, "SDF") << "no HTML";
}

TEST(Sdf, BadFilesAreRefused) {
  expect_refused("a.sdf", kAcetate.substr(0, 150), ":4: the count says 4 atoms, but the file ends after");
  expect_refused("a.sdf", "title\n\n", "ends where molecule 1 should begin");
  expect_refused("a.sdf", "title\n\n\nno counts\n", ":4: 'no counts' should begin with the numbers of atoms and bonds");
  expect_refused("a.sdf", with(kAcetate, "  4  3", "  5  3"),
                 ":9: '  1  2  1  0' is not an atom: x, y, z and a symbol");
  expect_refused("a.sdf", with(kAcetate, "  4  3", "  3  3"),
                 ":8: '   -2.1000   -1.1000    0.7000 O   0  5' is not a bond");
  expect_refused("a.sdf", with(kAcetate, "  4  3", "  3  0"),
                 ":8: '   -2.1000   -1.1000    0.7000 O   0  5' is one atom more");
  expect_refused("a.sdf", with(kAcetate, "  4  3", "  4  9"), ":4: the count says 9 bonds, but 3 follow");
  expect_refused("a.sdf", with(kAcetate, "  1  2  1", "  1  7  1"), ":9: a bond names atom '7'; the atoms are 1 to 4");
  expect_refused("a.sdf", with(kAcetate, "  1  2  1", "  2  2  1"), ":9: atom 2 is bonded to itself");
  expect_refused("a.sdf", with(kAcetate, "    1.5000    0.0000", "       nan    0.0000"), ":6: coordinate x is 'nan'");
  expect_refused("a.sdf", with(kAcetate, "    1.5000", " 1500000.0"), ":6: coordinate x is 1500000 Å, beyond");
  expect_refused("a.sdf", with(kAcetate, "M  END", "M  CHG  1   9   1"), ":12: charge '1' of atom '9'");
  expect_refused("a.sdf", kAcetate + "> <atom.dprop.PartialCharge>\n0.1 0.2\n\n",
                 ":13: 2 partial charges follow for 4 atoms");
  expect_refused("a.sdf", kV3000.substr(0, kV3000.find("M  V30 7")), "ends a molecule without M  END");
  expect_refused("a.sdf", with(kV3000, "COUNTS 3", "COUNTS 4"), "COUNTS says 4 atoms, but 3 follow");
  expect_refused("a.sdf", with(kV3000, "1 1 10 20", "1 1 10 2"), "a bond names atom '2'");
  expect_refused("a.sdf", with(kV3000, "M  V30 20", "M  V30 10"), "atom 10 appears twice");
  expect_refused("a.sdf", with(with(with(kAcetate, "  4  3", "  0  0"), "acetate", ""), "M  END", "M  END\n$$$$"),
                 "is one atom more");
}

const std::string kMol2 =
    "# a comment\n@<TRIPOS>MOLECULE\nmethanol and a glycine\n 5 3 2\nPROTEIN\nUSER_CHARGES\n\n"
    "@<TRIPOS>ATOM\n"
    "1 C1 0.0 0.0 0.0 C.3 1 MOH9 -0.125\n"
    "2 O1 1.4 0.0 0.0 O.3 1 MOH9 0.5\n"
    "30 N 9.0 0.0 0.5 N.am 2 GLY12 0.25\n"
    "4 CA 9.0 1.5 \\\n 0.5 C.3 2 GLY12 -0.25 BACKBONE\n"
    "5 Zn1 5 5 5 Zn 3 <0> 2.0\n"
    "@<TRIPOS>BOND\n1 1 2 1\n2 4 30 am\n3 1 5 nc\n"
    "@<TRIPOS>SUBSTRUCTURE\n1 MOH9 1\n2 GLY12 30 RESIDUE 1 A GLY 1 ROOT\n";

TEST(Mol2, AtomsChargesResiduesAndBonds) {
  const FileContents contents = contents_of("a.mol2", kMol2);
  ASSERT_EQ(contents.atoms.size(), 5u);
  EXPECT_EQ(contents.atoms[0].residue_name, "MOH");
  EXPECT_EQ(contents.atoms[0].residue_number, 9);
  EXPECT_EQ(contents.atoms[0].kind, AtomClass::ligand);
  EXPECT_EQ(contents.atoms[0].charge, -0.125F);
  EXPECT_EQ(contents.atoms[1].element, 8);
  EXPECT_EQ(contents.atoms[2].residue_name, "GLY");
  EXPECT_EQ(contents.atoms[2].residue_number, 12);
  EXPECT_EQ(contents.atoms[2].chain, "A");
  EXPECT_EQ(contents.atoms[2].element, 7);
  EXPECT_EQ(contents.atoms[2].kind, AtomClass::polymer);
  EXPECT_EQ(contents.atoms[3].position, glm::dvec3(9, 1.5, 0.5));
  EXPECT_EQ(contents.atoms[3].residue, 1u);
  EXPECT_EQ(contents.atoms[4].residue_name, "UNL");
  EXPECT_EQ(contents.atoms[4].kind, AtomClass::ion);
  EXPECT_EQ(contents.bonds, (std::vector<Bond>{{0, 1}, {2, 3}}));
  EXPECT_EQ(read_text("a", kMol2).format, "MOL2");
}

TEST(Mol2, ElementsOfEveryKindOfType) {
  const std::pair<const char*, int> types[] = {{"C.ar", 6}, {"Cl", 17}, {"Co.oh", 27}, {"H.spc", 1}, {"Du", 0},
                                               {"ca", 6},   {"cl", 17}, {"hc", 1},     {"na", 7},    {"os", 8},
                                               {"Na", 11},  {"LP", 0},  {"S.o2", 16},  {"Hal", 0},   {"D", 1}};
  for (const auto& [type, element] : types) {
    const FileContents contents = contents_of(
        "a.mol2", fmt::format("@<TRIPOS>MOLECULE\nm\n1\nSMALL\nNO_CHARGES\n@<TRIPOS>ATOM\n1 X 0 0 0 {}\n", type));
    EXPECT_EQ(contents.atoms.at(0).element, element) << type;
    EXPECT_TRUE(std::isnan(contents.atoms[0].charge));
  }
  const FileContents amber = contents_of(
      "a.mol2", "@<TRIPOS>MOLECULE\nm\n2\nSMALL\nbcc\n@<TRIPOS>ATOM\n1 C7 0 0 0 CA 1 L 0.1\n2 Cl1 2 0 0 CL 1 L -0.1\n");
  EXPECT_EQ(amber.atoms[0].element, 6);
  EXPECT_EQ(amber.atoms[1].element, 17);
  ASSERT_EQ(amber.warnings.size(), 1u);
  EXPECT_EQ(amber.warnings[0].text,
            "2 atoms have a type that names no element; elements were guessed from the names (first: line 7, 'CA')");
}

std::string mol2_of(const std::vector<std::pair<std::string, std::string>>& names_and_types) {
  std::string text = fmt::format("@<TRIPOS>MOLECULE\nm\n{}\nSMALL\nX\n@<TRIPOS>ATOM\n", names_and_types.size());
  int id = 0;
  for (const auto& [name, type] : names_and_types) {
    ++id;
    text += fmt::format("{} {} {} 0 0 {} 1 LIG 0.1\n", id, name, 2 * id, type);
  }
  return text;
}

std::vector<int> elements_of(const FileContents& contents) {
  std::vector<int> elements;
  for (const Atom& atom : contents.atoms) elements.push_back(atom.element);
  return elements;
}

TEST(Mol2, TypesOfNoTableAreNotBelieved) {
  const FileContents opls = contents_of("a.mol2", mol2_of({{"N", "opls_"},
                                                           {"HA", "opls_135"},
                                                           {"CB", "no_type"},
                                                           {"CL1", "c9"},
                                                           {"O", "sO"},
                                                           {"S1", "fe"},
                                                           {"C1", "c3"},
                                                           {"C2", "c.3"},
                                                           {"H1", "hL"}}));
  EXPECT_EQ(elements_of(opls), (std::vector<int>{7, 1, 6, 17, 8, 16, 6, 6, 1}));
  ASSERT_EQ(opls.warnings.size(), 1u);
  EXPECT_EQ(opls.warnings[0].text,
            "6 atoms have a type that names no element; elements were guessed from the names (first: line 7, "
            "'opls_')");
}

TEST(Mol2, TypesOfGlycamAreNoMetalsBesideItsCarbon) {
  const FileContents sugar = contents_of(
      "a.mol2", mol2_of({{"C1", "Cg"}, {"H1O", "Ho"}, {"O5", "Os"}, {"S1", "Sm"}, {"H1", "H2"}, {"O2", "Oh"}}));
  EXPECT_EQ(elements_of(sugar), (std::vector<int>{6, 1, 8, 16, 1, 8}));
  EXPECT_EQ(elements_of(contents_of("a.mol2", mol2_of({{"OS1", "Os"}, {"N1", "N.3"}}))), (std::vector<int>{76, 7}));
}

TEST(Mol2, LonePairsAreSites) {
  const FileContents contents = contents_of("a.mol2", mol2_of({{"N1", "N.3"}, {"C9", "LP"}}));
  EXPECT_EQ(contents.sites, (std::vector<bool>{false, true}));
  EXPECT_EQ(contents.atoms[1].element, 0);
}

TEST(Mol2, FieldsOfTheWrongKindAreNoticed) {
  const auto warnings = [](const std::string& fields) {
    return contents_of("a.mol2", "@<TRIPOS>MOLECULE\nm\n1\nSMALL\nX\n@<TRIPOS>ATOM\n1 C1 0 0 0 C.3 " + fields + "\n")
        .warnings;
  };
  for (const char* good :
       {"", "1", "1 LIG", "1 4NZ", "1 LIG 0.5", "1 LIG 1", "1 LIG 0.5 BACKBONE|DICT", "1 LIG 0.5 ****"})
    EXPECT_TRUE(warnings(good).empty()) << good;
  for (const char* bad : {"1 0.5", "1 LIG 1 -0.5", "1 LIG 0.0 0"}) {
    ASSERT_EQ(warnings(bad).size(), 1u) << bad;
    EXPECT_NE(warnings(bad)[0].text.find("1 atom has a number where the name of the substructure or status bits"),
              std::string::npos);
  }
  expect_refused("a.mol2", "@<TRIPOS>MOLECULE\nm\n1\nSMALL\nX\n@<TRIPOS>ATOM\n1 C 1 0.0 1.0 2.0 C.3 1 LIG 0.5\n",
                 ":7: substructure 'C.3' is not a number; columns may have run together");
}

TEST(Mol2, NamesOfSubstructures) {
  const auto residue = [](const std::string& name, int id) {
    const FileContents contents = contents_of(
        "a.mol2", fmt::format("@<TRIPOS>MOLECULE\nm\n1\nSMALL\nX\n@<TRIPOS>ATOM\n1 C 0 0 0 C.3 {} {} 0\n", id, name));
    return fmt::format("{} {}", contents.atoms.at(0).residue_name, contents.atoms[0].residue_number);
  };
  EXPECT_EQ(residue("ALA12", 1), "ALA 12");
  EXPECT_EQ(residue("G39", 1), "G39 1");
  EXPECT_EQ(residue("0E6", 3), "0E6 3");
  EXPECT_EQ(residue("LIG", 7), "LIG 7");
  EXPECT_EQ(residue("****", 1), "UNL 1");
  EXPECT_EQ(residue("<1>", 1), "UNL 1");
  const FileContents unknown =
      contents_of("a.mol2", "@<TRIPOS>MOLECULE\nm\n1\nSMALL\nX\n@<TRIPOS>ATOM\n1 Na1 0 0 0 Na 1 UNK1 1\n");
  EXPECT_EQ(unknown.atoms[0].element, 11);
  EXPECT_EQ(unknown.atoms[0].kind, AtomClass::ligand) << "not an unknown amino acid";
}

TEST(Mol2, MoleculesAreModels) {
  const std::string two =
      kMol2 + "@<TRIPOS>MOLECULE\n\n1 0\nSMALL\nNO_CHARGES\n@<TRIPOS>ATOM\n1 C 7 0 0 C.3 1 LIG 0.0\n";
  const FileContents first = contents_of("a.mol2", two);
  EXPECT_EQ(first.models, 2u);
  EXPECT_EQ(first.other_model_atoms, 1u);
  const std::vector<Warning> warnings = read_text("a.mol2", two).report.warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].text.find("2 molecules are in the file"), std::string::npos);
  const FileContents second = contents_of("a.mol2", two, {2, false});
  EXPECT_EQ(second.atoms.at(0).position.x, 7.0);
  EXPECT_TRUE(std::isnan(second.atoms[0].charge));
  EXPECT_EQ(second.other_model_atoms, 5u);
}

TEST(Mol2, BadFilesAreRefused) {
  expect_refused("a.mol2", kMol2.substr(0, kMol2.find("4 CA")), ":4: the count says 5 atoms, but 3 follow");
  expect_refused("a.mol2", with(kMol2, " 5 3 2", " 4 3 2"), "is one atom more than line 4 says");
  expect_refused("a.mol2", with(kMol2, " 5 3 2", " 5 9 2"), ":4: the count says 9 bonds, but 3 follow");
  expect_refused("a.mol2", with(kMol2, " 5 3 2", "many"), ":4: the molecule of line 2 has no name and number of atoms");
  expect_refused("a.mol2", with(kMol2, "2 O1 1.4", "2 O1 nan"), ":10: coordinate x is 'nan'");
  expect_refused("a.mol2", with(kMol2, "MOH9 0.5", "MOH9 x"), ":10: charge is 'x', not a finite number");
  expect_refused("a.mol2", with(kMol2, "2 O1 1.4 0.0 0.0 O.3 1 MOH9 0.5", "2 O1 1.4"),
                 ":10: '2 O1 1.4' is not an atom");
  expect_refused("a.mol2", with(kMol2, "2 O1", "1 O1"), ":10: atom 1 appears twice");
  expect_refused("a.mol2", with(kMol2, "1 1 2 1", "1 1 77 1"),
                 ":16: a bond names atom '77', which molecule 1 does not have");
  expect_refused("a.mol2", "@<TRIPOS>MOLECULE\nm\n0\n", "has no atoms after @<TRIPOS>ATOM");
}

std::string pdbqt_line(int serial, const std::string& name, const std::string& residue, double x,
                       const std::string& charge, const std::string& type) {
  return fmt::format("ATOM  {:>5} {:<4} {:>3} A   1    {:8.3f}   2.000   3.000  1.00  0.00    {:>6} {:<2}\n", serial,
                     name, residue, x, charge, type);
}

const std::string kPose = "ROOT\n" + pdbqt_line(1, " C1", "UNL", 0, "+0.103", "A") + "ENDROOT\nBRANCH   1   2\n" +
                          pdbqt_line(2, " N1", "UNL", 1.4, "-0.350", "NA") +
                          pdbqt_line(3, " H1", "UNL", 2.4, "0.200", "HD") +
                          pdbqt_line(4, " G", "UNL", 3.4, "0.000", "G0") + "ENDBRANCH   1   2\nTORSDOF 1\n";

TEST(Pdbqt, ChargesTypesAndPoses) {
  const std::string poses = "MODEL 1\nREMARK VINA RESULT: -9.1\n" + kPose + "ENDMDL\nMODEL 2\n" + kPose + "ENDMDL\n";
  const Structure structure = read_text("a.pdbqt", poses);
  EXPECT_EQ(structure.format, "PDBQT");
  EXPECT_EQ(structure.report.sentence(), "8 atoms read; 4 in other models, 1 virtual site left out; 3 used");
  ASSERT_EQ(structure.atoms.size(), 3u);
  const int elements[] = {6, 7, 1};
  for (std::size_t n = 0; n < 3; ++n) EXPECT_EQ(structure.atoms[n].element, elements[n]) << n;
  EXPECT_EQ(structure.atoms[0].charge, 0.103F);
  EXPECT_EQ(structure.atoms[1].charge, -0.35F);
  EXPECT_EQ(structure.atoms[0].kind, AtomClass::ligand);
  EXPECT_EQ(structure.atoms[0].chain, "A");
  EXPECT_EQ(structure.atoms[0].segment, "");
  EXPECT_TRUE(structure.report.warnings.empty());
  EXPECT_EQ(contents_of("a.pdbqt", poses).bonds, (std::vector<Bond>{{0, 1}}));
  EXPECT_EQ(read_text("a", kPose).format, "PDBQT");
  const std::string pdb = "ATOM      1  N   ALA A   1      17.047  14.099   3.625  1.00 10.00      SEG  N  \n";
  EXPECT_EQ(read_text("a", pdb).format, "PDB");
}

TEST(Pdbqt, TypesOfAutodock) {
  const std::pair<const char*, int> types[] = {{"OA", 8},  {"SA", 16}, {"NS", 7}, {"HS", 1},  {"Cl", 17}, {"Zn", 30},
                                               {"Br", 35}, {"CG0", 6}, {"W", 8},  {"Si", 14}, {"Na", 11}, {"TZ", 0}};
  for (const auto& [type, element] : types)
    EXPECT_EQ(contents_of("a.pdbqt", pdbqt_line(1, " Q", "UNL", 0, "0.1", type)).atoms.at(0).element, element) << type;
  const FileContents unknown = contents_of("a.pdbqt", pdbqt_line(1, " C1", "UNL", 0, "0.1", "Xy"));
  EXPECT_EQ(unknown.atoms.at(0).element, 6);
  EXPECT_EQ(unknown.warnings.size(), 1u);
}

TEST(Pdbqt, BadFilesAreRefused) {
  expect_refused("a.pdbqt", kPose + pdbqt_line(5, " C", "UNL", 0, "x", "C"), ":10: charge in columns 67 to 76 is 'x'");
  expect_refused("a.pdbqt", kPose + pdbqt_line(5, " C", "UNL", 0, "0.1", ""), ":10: atom record 'ATOM ");
  expect_refused("a.pdbqt", kPose + pdbqt_line(5, " C", "UNL", NAN, "0.1", "C"), ":10: coordinate x is 'nan     '");
  expect_refused("a.pdbqt", kPose + "ATOM      5  C   UNL A   1       1.000\n", ":10: atom record");
  expect_refused("a.pdbqt", "ROOT\nENDROOT\nTORSDOF 0\n", "has no ATOM or HETATM records");
}

}  // namespace
}  // namespace meniscus
