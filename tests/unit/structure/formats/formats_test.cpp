// SPDX-License-Identifier: BSD-3-Clause
// Formats other than PDB and mmCIF: contents of good and odd files of each, and their recognition.
#include "core/structure/formats/read_structure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/run_program.h"
#include "tests/support/pdb_line.h"

namespace meniscus {
namespace {

using test::PdbLine;
using test::TemporaryFolder;

/// Reads all atoms of a file but water and ions.
Structure read_text(const std::string& name, std::string_view text, ReadOptions options = {}) {
  const TemporaryFolder folder;
  options.takes_ligands = true;
  return read_structure(folder.file(name, text), options);
}

ReadOptions with_model(std::int32_t number) {
  ReadOptions options;
  options.model.number = number;
  return options;
}

ReadOptions all_models() {
  ReadOptions options;
  options.model.all = true;
  return options;
}

std::string pqr_line(const std::string& names, double x, const std::string& charge_and_radius) {
  return fmt::format("ATOM {} {} 2.5 -3.25 {}\n", names, x, charge_and_radius);
}

TEST(Pqr, ChainIsOptionalAndInsertionCodesAreRead) {
  const Structure structure =
      read_text("a.pqr", pqr_line("1 N MET 1", 1, "-0.3 1.85") + pqr_line("2 CA MET A 2", 2, "0.1 2.0") +
                             pqr_line("3 C MET B 52A", 3, "0 1") + pqr_line("4 O MET B 52 B", 4, "0 1.5"));
  EXPECT_EQ(structure.format, "PQR");
  EXPECT_EQ(structure.radii_set, "file");
  ASSERT_EQ(structure.atoms.size(), 4u);
  EXPECT_EQ(structure.atoms[0].position, glm::dvec3(1, 2.5, -3.25));
  EXPECT_FLOAT_EQ(structure.atoms[0].charge, -0.3f);
  EXPECT_EQ(structure.atoms[0].radius, 1.85);
  EXPECT_EQ(structure.atoms[0].chain, "");
  EXPECT_EQ(structure.atoms[1].chain, "A");
  EXPECT_EQ(structure.atoms[1].name, "CA");
  EXPECT_EQ(structure.atoms[1].element, 6);
  EXPECT_EQ(structure.atoms[2].insertion_code, 'A');
  EXPECT_EQ(structure.atoms[3].insertion_code, 'B');
  EXPECT_EQ(structure.atoms[3].residue_number, 52);
  EXPECT_EQ(structure.atoms[3].residue, 3u);
}

TEST(Pqr, FieldsThatTouchAreReadAtTheColumnsOfPdb) {
  const Structure structure = read_text("a.pqr",
                                        "ATOM      1 HG21AVAL A1000    -100.125-100.250-100.500 -0.3000 1.5000\n"
                                        "ATOM  12345 HG22 VALX   11      17.047  14.099   3.625  0.2500 1.2500\n"
                                        "ATOM  12345 HG23AVAL A  11      27.047  14.099   3.625  0.2500 1.2500\n"
                                        "HETATM12346  C1  LIG A 12       1.000   2.000   3.000  0.5000 2.0000\n");
  ASSERT_EQ(structure.atoms.size(), 4u);
  EXPECT_EQ(structure.atoms[0].name, "HG21");
  EXPECT_EQ(structure.atoms[0].residue_name, "VAL");
  EXPECT_EQ(structure.atoms[0].altloc, 'A');
  EXPECT_EQ(structure.atoms[0].chain, "A");
  EXPECT_EQ(structure.atoms[0].residue_number, 1000);
  EXPECT_EQ(structure.atoms[0].position, glm::dvec3(-100.125, -100.25, -100.5));
  EXPECT_EQ(structure.atoms[1].name, "HG22");
  EXPECT_EQ(structure.atoms[1].residue_name, "VALX");
  EXPECT_EQ(structure.atoms[1].residue_number, 11);
  EXPECT_EQ(structure.atoms[2].name, "HG23") << "between blanks it would be HG23AVAL in residue A";
  EXPECT_EQ(structure.atoms[2].chain, "A");
  EXPECT_EQ(structure.atoms[3].name, "C1");
  EXPECT_EQ(structure.atoms[3].radius, 2.0);
}

TEST(Pqr, WaterIonsAndAtomsOfRadiusZeroAreLeftOut) {
  const Structure structure =
      read_text("a.pqr", pqr_line("1 N MET A 1", 1, "-0.3 1.85") + pqr_line("2 HA MET A 1", 2, "0.1 0.0") +
                             pqr_line("3 O HOH A 2", 3, "-0.8 1.6") + pqr_line("4 CA CA A 3", 4, "2.0 1.3"));
  EXPECT_EQ(structure.report.sentence(), "4 atoms read; 1 of radius zero, 1 water atom, 1 free ion left out; 1 used");
}

TEST(Pqr, RadiiThatLookLikeOtherColumnsAreWarnedAbout) {
  const Structure structure =
      read_text("a.pqr", pqr_line("1 N MET A 1", 1, "10.5 1.00") + pqr_line("2 CA MET A 1", 2, "11.5 1.00"));
  ASSERT_EQ(structure.report.warnings.size(), 1u);
  EXPECT_EQ(structure.report.warnings[0].text, "all radii are 1 Å; is the last column the radius?");
}

constexpr const char* kGro =
    "Two waters, t= 0.0\n"
    "    4\n"
    "    1SOL     OW    1   0.126   1.624  -1.679  0.1227 -0.0580  0.0434\n"
    "    1SOL    HW1    2   0.190   1.661   1.747\n"
    "    2GLY     CA    3   0.177   1.568   1.613\n"
    "    3NA      NA    4   1.275   0.053   0.622\n"
    "   1.82060   1.82060   1.82060   0.0 0.0 0.5 0.0 0.5 0.5\n";

TEST(Gro, NanometresBecomeAngstromAndNamesTellElements) {
  ReadOptions keep;
  keep.keep_water = keep.keep_ions = true;
  const Structure structure = read_text("a.gro", kGro, keep);
  EXPECT_EQ(structure.format, "GRO");
  ASSERT_EQ(structure.atoms.size(), 4u);
  EXPECT_DOUBLE_EQ(structure.atoms[0].position.x, 1.26);
  EXPECT_DOUBLE_EQ(structure.atoms[0].position.z, -16.79);
  EXPECT_EQ(structure.atoms[0].kind, AtomClass::water);
  EXPECT_EQ(structure.atoms[1].element, 1);
  EXPECT_EQ(structure.atoms[2].element, 6);
  EXPECT_EQ(structure.atoms[2].kind, AtomClass::polymer);
  EXPECT_EQ(structure.atoms[3].element, 11);
  EXPECT_EQ(structure.atoms[3].kind, AtomClass::ion);
  EXPECT_EQ(structure.atoms[3].residue, 2u);
  EXPECT_EQ(read_text("a.gro", kGro).report.sentence(), "4 atoms read; 2 water atoms, 1 free ion left out; 1 used");
}

TEST(Gro, MoreDecimalsMakeWiderColumns) {
  const std::string text = "precise\n1\n    1GLY     CA    1    1.234567   -2.345678    3.456789  0.12345678\n 1 1 1\n";
  const Structure structure = read_text("a.gro", text);
  EXPECT_DOUBLE_EQ(structure.atoms[0].position.y, -23.45678);
}

TEST(Gro, FramesAreModelsAndTitlesMayBeBlank) {
  std::string second = kGro;
  second.replace(0, second.find('\n'), "");
  second.replace(second.find("0.177"), 5, "0.999");
  const std::string both = kGro + second + "\n\n";
  EXPECT_EQ(read_text("a.gro", both).report.sentence(),
            "8 atoms read; 4 in other models, 2 water atoms, 1 free ion left out; 1 used");
  EXPECT_DOUBLE_EQ(read_text("a.gro", both, with_model(2)).atoms[0].position.x, 9.99);
  const Structure all = read_text("a.gro", both, all_models());
  ASSERT_EQ(all.atoms.size(), 2u);
  EXPECT_EQ(all.atoms[0].model, 1);
  EXPECT_EQ(all.atoms[1].model, 2);
  EXPECT_EQ(all.report.models, 2u);
}

TEST(Gro, ResiduesStayDistinctAfter99999) {
  std::string text = "wrap\n100002\n";
  for (int n = 0; n < 100002; ++n) {
    text += fmt::format("{:>5}SOL     OW{:>5}{:>8.3f}   0.000   0.000\n", (n + 1) % 100000, (n + 1) % 100000, n * 0.01);
  }
  text += " 1 1 1\n";
  ReadOptions keep;
  keep.keep_water = true;
  const Structure structure = read_text("a.gro", text, keep);
  ASSERT_EQ(structure.atoms.size(), 100002u);
  EXPECT_EQ(structure.atoms[100000].residue_number, 1);
  EXPECT_EQ(structure.atoms[100000].residue, 100000u);
  EXPECT_EQ(structure.atoms[0].residue, 0u);
}

TEST(Xyz, SymbolsNumbersExponentsAndFurtherColumns) {
  const Structure structure =
      read_text("a.xyz", "5\n\nC 1.5 2D0 -3d-1\n8 0 0 9.0 extra 7\nCl1 4 5 6\nh 7 8 +9\nBR 1e1 0 0\n");
  EXPECT_EQ(structure.format, "XYZ");
  ASSERT_EQ(structure.atoms.size(), 5u);
  EXPECT_EQ(structure.atoms[0].position, glm::dvec3(1.5, 2.0, -0.3));
  const int elements[] = {6, 8, 17, 1, 35};
  for (std::size_t n = 0; n < 5; ++n) EXPECT_EQ(structure.atoms[n].element, elements[n]) << n;
  EXPECT_EQ(structure.atoms[1].radius, 1.52);
  EXPECT_EQ(structure.atoms[0].kind, AtomClass::unclassified);
}

TEST(Xyz, ExtendedCommentsSayWhereThePositionIs) {
  const Structure structure =
      read_text("a.extxyz",
                "1\nLattice=\"5 0 0 0 5 0 0 0 5\" Properties=id:I:1:forces:R:3:pos:R:3:species:S:1 pbc=\"T T T\"\n"
                "17 0.1 0.2 0.3 1.0 2.0 3.0 Si\n");
  EXPECT_EQ(structure.atoms.at(0).position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(structure.atoms.at(0).element, 14);
}

TEST(Xyz, FramesAreModels) {
  const std::string text = "2\nframe 1\nO 0 0 0\nH 1 0 0\n1\nframe 2\nO 5 0 0\n\n";
  const Structure first = read_text("a.xyz", text);
  EXPECT_EQ(first.report.sentence(), "3 atoms read; 1 in other models left out; 2 used");
  EXPECT_EQ(read_text("a.xyz", text, with_model(2)).atoms.at(0).position.x, 5.0);
  EXPECT_EQ(read_text("a.xyz", text, all_models()).atoms.size(), 3u);
  EXPECT_THROW(read_text("a.xyz", text, with_model(3)), InputError);
}

TEST(Xyz, DummiesHaveNoElement) {
  ReadOptions options;
  options.unknown_element = UnknownElement::skip;
  EXPECT_EQ(read_text("a.xyz", "3\n\nC 0 0 0\nX 1 0 0\n0 2 0 0\n", options).report.sentence(),
            "3 atoms read; 2 of unknown element left out; 1 used");
}

TEST(Xyz, TypesOfLammpsAreNoElements) {
  for (const char* comment : {"Atoms. Timestep: 0", "Atoms. Timestep: 100 Time: 0.5", "Atoms"}) {
    try {
      read_text("a.xyz", fmt::format("3\n{}\n1 0 0 0\n2 3 0 0\n6 6 0 0\n", comment));
      ADD_FAILURE() << comment;
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("the element of 3 atoms is unknown: '1' (atom 1)"), std::string::npos) << message;
      EXPECT_NE(message.find("the numbers are LAMMPS' types of atoms"), std::string::npos) << message;
    }
    const Structure symbols = read_text("a.xyz", fmt::format("2\n{}\nC 0 0 0\nO 3 0 0\n", comment));
    EXPECT_EQ(symbols.atoms.at(1).element, 8);
    EXPECT_TRUE(symbols.report.warnings.empty());
  }
}

TEST(Xyz, NumbersThatRunFromOneMayBeTypes) {
  const auto warnings = [](const char* atoms) {
    const std::string text(atoms);
    return read_text("a.xyz", fmt::format("{}\n\n{}", std::count(text.begin(), text.end(), '\n'), text))
        .report.warnings;
  };
  const std::vector<Warning> four = warnings("1 0 0 0\n2 3 0 0\n3 6 0 0\n4 9 0 0\n1 12 0 0\n");
  ASSERT_FALSE(four.empty());
  EXPECT_EQ(four[0].text,
            "the elements are numbers from 1 to 4, and count as H, He and so on; if these are types of a simulation, "
            "put symbols in their place");
  EXPECT_EQ(warnings("1 0 0 0\n2 3 0 0\n").size(), 1u);
  for (const char* good :
       {"1 0 0 0\n1 3 0 0\n", "1 0 0 0\n6 3 0 0\n8 6 0 0\n", "1 0 0 0\n2 3 0 0\nC 6 0 0\n", "2 0 0 0\n3 3 0 0\n"})
    EXPECT_TRUE(warnings(good).empty()) << good;
}

TEST(Gro, LonePairsOfAnyLetterAreLeftOut) {
  const std::string gro =
      "chlorobenzene\n2\n    1LIG    CL1    1   0.100   0.100   0.100\n    1LIG    LPA    2   0.264   0.100   0.100\n"
      " 1 1 1\n";
  const Structure structure = read_text("a.gro", gro);
  EXPECT_EQ(structure.report.sentence(), "2 atoms read; 1 virtual site left out; 1 used");
  EXPECT_EQ(structure.atoms.at(0).element, 17);
}

TEST(Format, ContentIsToldWithoutAName) {
  EXPECT_EQ(read_text("a", kGro).format, "GRO");
  EXPECT_EQ(read_text("a.txt", "1\n\nC 0 0 0\n").format, "XYZ");
  EXPECT_EQ(read_text("a.dat", PdbLine{}.text()).format, "PDB");
  EXPECT_EQ(read_text("a", "ATOM      1  N   THR     1      17.047  14.099   3.625 -0.3200 2.0000\n").format, "PQR");
  EXPECT_EQ(read_text("a", pqr_line("1 N MET A 1", 1, "-0.3 1.85")).format, "PQR");
  EXPECT_EQ(read_text("a", "0 0 0 1.7\n").format, "XYZR");
}

TEST(Format, TheNameDecidesWhereBothMayBe) {
  PdbLine line;
  line.element = "  ";
  EXPECT_EQ(read_text("a", line.text()).format, "PDB");
  EXPECT_EQ(read_text("a.pqr", line.text()).format, "PQR");
}

TEST(Format, EachIsReadFromGzip) {
  EXPECT_EQ(read_text("a.gro.gz", test::gzipped(kGro)).atoms.size(), 1u);
  EXPECT_EQ(read_text("a.xyz.gz", test::gzipped("1\n\nC 0 0 0\n")).atoms.size(), 1u);
  EXPECT_EQ(read_text("a.pqr.gz", test::gzipped(pqr_line("1 N MET A 1", 1, "-0.3 1.85"))).atoms.size(), 1u);
}

TEST(StandardInput, IsReadUpToItsBound) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a", kGro);
  ASSERT_NE(std::freopen(path.c_str(), "rb", stdin), nullptr);
  EXPECT_THROW(read_text_file("-", 100), CapacityError);
  ASSERT_NE(std::freopen(path.c_str(), "rb", stdin), nullptr);
  EXPECT_EQ(read_text_file("-").text, kGro);
  EXPECT_EQ(read_text_file(path).path, path);
}

TEST(Unit, NanometresAreDoubted) {
  const auto chain = [](double spacing) {
    std::string text;
    for (int n = 0; n < 12; ++n) text += PdbLine{.number = n, .x = fmt::format("{:8.3f}", spacing * n)}.text();
    return read_text("a.pdb", text).report.warnings;
  };
  EXPECT_TRUE(chain(1.5).empty());
  ASSERT_EQ(chain(0.15).size(), 1u);
  EXPECT_EQ(chain(0.15)[0].text,
            "atoms lie 0.15 Å from their nearest neighbour (median); are the coordinates in nanometres?");
}

TEST(Model, OneThatIsNotThereIsAnError) {
  const TemporaryFolder folder;
  const std::string model = "MODEL        1\n" + PdbLine{}.text() + "ENDMDL\n";
  const std::string path = folder.file("a.pdb", model + model);
  try {
    read_structure(path, with_model(3));
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()), path + ": has no model 3: it holds 2 models; choose --model 1 to 2");
  }
  EXPECT_EQ(read_structure(path, with_model(2)).atoms.at(0).model, 2);
  const Structure all = read_structure(path, all_models());
  EXPECT_EQ(all.atoms.size(), 2u);
  EXPECT_NE(all.atoms[0].residue, all.atoms[1].residue);
  EXPECT_EQ(all.report.models, 2u);
}

}  // namespace
}  // namespace meniscus
