// SPDX-License-Identifier: BSD-3-Clause
// Colours by numbers from files of residues, tables and frames, with their gaps and faults.
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "core/color/color_schemes.h"
#include "core/color/named_colors.h"
#include "tests/support/run_program.h"
#include "tests/unit/color/colored_atoms.h"

namespace meniscus {
namespace {

TEST(Colors, NumbersByResidueAndOfTables) {
  const test::TemporaryFolder folder;
  Structure structure = four_atoms();
  for (std::size_t a = 0; a < 4; ++a) structure.atoms[a].residue_number = static_cast<std::int32_t>(a) - 1;
  structure.atoms[1].insertion_code = 'B';
  const auto numbers = [&](const char* text, const char* column = "") {
    ColorScheme wish = scheme("file");
    wish.file = read_number_file(folder.file("n", text), column);
    return color_scale(structure, wish);
  };
  const char* const layouts[] = {
      "A -1 1.5\nA 0B 2\nB 1 ?\nA 2 4e0\n",
      "chain resid value\nA -1 1.5\nA 0B 2\nA 2 4\nZ 9 9\n",
      "chain,number,icode,sas\nA,-1,,1.5\nA,0,B,2\n\"A\",2,,4\n",
      "index,sas\n0,1.5\n1,2\n3,4\n2,-\n",
      "A,-1,1.5\nA,0B,2\nB,1,-\nA,2,4\n",
      "A;-1;1,5\nA;0B;2\nB;1;NA\nA;2;4,0\n",
      "A\t-1\t1.5\nA\t0B\t2\nA\t2\t4\n",
      "Chain;Resi;Score\n\"A\";-1;1,5\nA;0B;2\nB;1;\nA;2;4\n;;\n",
      "\tchain\tresid\tscore\n0\tA\t-1\t1.5\n1\tA\t0B\t2\n2\tA\t2\t4\n",
      "resn\tscore\tauth_seq_id\tchain_id\nASP\t1.5\t-1\tA\nLYS\t2\t0B\tA\n\nGLY\tN/A\t1\tB\nUNX\t4\t2.0\tA\n",
      "chain residue aa score\nA -1 D 1.5\nA 0B K 2\nA 2 X 4\n"};
  for (const char* text : layouts) {
    const std::vector<double> value = numbers(text).value;
    ASSERT_EQ(value.size(), 4u);
    EXPECT_EQ(value[0], 1.5) << text;
    EXPECT_EQ(value[1], 2.0) << text;
    EXPECT_TRUE(std::isnan(value[2])) << text;
    EXPECT_EQ(value[3], 4.0) << text;
  }
  const char* const table = "chain,number,ses,sas\nA,-1,1,10\nB,1,2,20\n";
  EXPECT_EQ(numbers(table, "sas").value[2], 20.0);
  EXPECT_EQ(numbers(table, "sas").title, "sas");
  const std::tuple<const char*, const char*, const char*> faults[] = {
      {table, "", "n:1: is a table; choose one of its columns by --color-column: ses, sas"},
      {table, "vdw", "n:1: has no column 'vdw'; it has ses, sas"},
      {"a,b\n1,2\n", "b", "n:1: is the header of a table that does not identify its atoms"},
      {"chain,number,x\nA,1\n", "", "n:2: has 2 cells, the header 3"},
      {"chain,number,x\nA,1x9,2\n", "", "n:2: '1x9' is not a residue number"},
      {"chain,number,x\nA,1,red\n", "", "n:2: 'red' is not a finite number"},
      {"index,x\n-1,2\n", "", "n:2: '-1' is not an atom index"},
      {"index,x\n1,2\n1,3\n", "", "n:3: gives atom 1 a second number"},
      {"red\n1\n", "", "n:1: 'red' is not a finite number; write one number for each atom of the file"},
      {"resn,chain,number\nALA,A,1\n", "", "n:1: is the header of a table without a column of numbers; write"},
      {"A 1 2\nA 1 3\n", "", "n:2: gives residue 1 of chain 'A' a second number"},
      {"A 1 2\nB 2\n", "", "n:2: should be a chain, the number of a residue and a value"},
      {"1 2 3\n", "x", "n:1: is not the header of a table"},
      {"Q 1 2\n", "", "names 1 residues, but none of them is among the atoms used of four"}};
  for (const auto& [text, column, reason] : faults) {
    const std::string said = complaint([&, text = text, column = column] { numbers(text, column); });
    EXPECT_NE(said.find(reason), std::string::npos) << text << ": " << said;
  }
}

TEST(Colors, AColumnWithAUsualNameIsOneOfNumbers) {
  const test::TemporaryFolder folder;
  Structure structure = four_atoms();
  const auto value = [&](const std::string& text, const char* column = "") {
    ColorScheme wish = scheme("file");
    wish.file = read_number_file(folder.file("n", text), column);
    return color_scale(structure, wish).value[0];
  };
  for (const std::string name : {"class", "name", "atom", "element", "radius", "atoms"}) {
    EXPECT_EQ(value("index," + name + "\n0,7\n"), 7.0) << name;
    EXPECT_EQ(value("index," + name + ",score\n0,7,5\n"), 5.0) << name << ": other numbers come first";
    EXPECT_EQ(value("index," + name + ",score\n0,7,5\n", name.c_str()), 7.0) << name;
    EXPECT_EQ(value("index," + name + ",score\n0,text,5\n"), 5.0) << name;
  }
  EXPECT_NE(complaint([&] { value("index,name,class\n0,1,2\n"); }).find("by --color-column: name, class"),
            std::string::npos);
}

TEST(Colors, AColumnOfColoursIsTakenAsItIs) {
  const test::TemporaryFolder folder;
  Structure structure = four_atoms();
  const auto read = [&](const char* text, const char* column = "") {
    ColorScheme wish = scheme("file");
    wish.set_numbers(read_number_file(folder.file("n", text), column));
    return wish;
  };
  for (const char* const text : {"index,color\n0,#ff8000\n1,#0000FF\n3,?\n", "color;index\n#ff8000;0\n#0000FF;1\n;3\n",
                                 "index color score\n0 #ff8000 x\n# a comment\n1 #0000FF x\n3 NA x\n"}) {
    const ColorScheme wish = read(text);
    const std::vector<glm::vec3> colors = color_atoms(structure, wish).atom;
    EXPECT_EQ(colors[0], color_from_hex(0xff8000)) << text;
    EXPECT_EQ(colors[1], color_from_hex(0x0000ff)) << text;
    EXPECT_EQ(colors[3], color_from_hex(0x808080)) << text;
    EXPECT_EQ(color_scale(structure, wish).classes.size(), 2u);
  }
  EXPECT_NE(complaint([&] { read("index,color\n0,#ff8000\n1,red\n"); }).find("n:3: 'red' is not a colour such as"),
            std::string::npos);
  ColorScheme mapped = scheme("file");
  mapped.map = ColorMap::magma;
  const NumberFile file = read_number_file(folder.file("n", "index,color\n0,#ff8000\n"));
  EXPECT_NE(complaint([&] { mapped.set_numbers(file); }).find("has colours of its own; leave --map"),
            std::string::npos);
}

TEST(Colors, TablesOfAOneChainMoleculeNeedNoChain) {
  const test::TemporaryFolder folder;
  Structure structure = four_atoms();
  for (std::size_t a = 0; a < 4; ++a) {
    structure.atoms[a].residue_number = static_cast<std::int32_t>(a);
    structure.atoms[a].kind = AtomClass::polymer;
  }
  structure.atoms[2].kind = AtomClass::ligand;  // The atom belongs to chain B.
  ColorScheme wish = scheme("file");
  for (const char* text : {"resid,score\n0,1.5\n1,2\n2,9\n3,4\n", "position;score\n0;1,5\n1;2\n2;9\n3;4\n",
                           "resi score\n0 1.5\n1 2\n2 9\n3 4\n"}) {
    wish.file = read_number_file(folder.file("n", text));
    const ColorScale scale = color_scale(structure, wish);
    EXPECT_EQ(scale.title, "score");
    EXPECT_EQ(scale.value[0], 1.5) << text;
    EXPECT_EQ(scale.value[3], 4.0) << text;
    EXPECT_TRUE(std::isnan(scale.value[2])) << "residue 2 is of another chain: " << text;
  }
  structure.atoms[2].kind = AtomClass::polymer;
  EXPECT_NE(
      complaint([&] {
        color_scale(structure, wish);
      }).find("names residues without their chains, but the atoms used of four belong to 2 chains, such as 'A' and"),
      std::string::npos);
  wish.file = read_number_file(folder.file("n", "0 1.5\n1 2\n2 9\n"));
  EXPECT_NE(complaint([&] { color_scale(structure, wish); }).find("or resid,score for a molecule of one chain"),
            std::string::npos);
}

TEST(Colors, NumbersOfFramesHaveOneScale) {
  const test::TemporaryFolder folder;
  Structure structure = four_atoms();
  const auto numbers = [&](const char* text, std::optional<std::uint64_t> frame) {
    ColorScheme wish = scheme("file");
    wish.set_numbers(read_number_file(folder.file("n", text)));
    structure.frame = frame;
    return color_scale(structure, wish);
  };
  for (std::size_t a = 0; a < 4; ++a) structure.atoms[a].residue_number = static_cast<std::int32_t>(a);
  for (const char* const table : {"frame,index,rmsd\n0,0,1\n0,1,-\n7,1,5\n7,2,3\n",
                                  "frame,chain,number,rmsd\n0,A,0,1\n0,A,1,nan\n7,A,1,5\n7,B,2,3\n"}) {
    const ColorScale first = numbers(table, 0), last = numbers(table, 7);
    EXPECT_EQ(first.range, (std::array<double, 2>{1.0, 5.0})) << table;
    EXPECT_EQ(last.range, first.range);
    EXPECT_EQ(first.title, "rmsd");
    EXPECT_EQ(first.value[0], 1.0);
    EXPECT_TRUE(std::isnan(first.value[1]) && std::isnan(last.value[0]));
    EXPECT_EQ(last.value[1], 5.0);
    EXPECT_EQ(last.value[2], 3.0);
  }
  const std::tuple<const char*, std::optional<std::uint64_t>, const char*> faults[] = {
      {"frame,index,x\n0,0,1\n2,0,2\n", 1, "holds numbers of 2 frames, 0 to 2, but none of frame 1"},
      {"frame,index,x\n0,0,1\n", {}, "holds numbers of 1 frame, 0 to 0; add --frames, or leave out its column frame"},
      {"frame,index,x\n-1,0,1\n", 0, "n:2: '-1' is not a frame number; frames count from 0"},
      {"frame,index,x\n1.5,0,1\n", 0, "n:2: '1.5' is not a frame number"},
      {"frame,index,x\n3,0,1\n3,0,2\n", 0, "n:3: gives atom 0 a second number"},
      {"frame,x\n3,1\n", 0, "n:1: is the header of a table that does not identify its atoms"}};
  for (const auto& [text, frame, reason] : faults) {
    const std::string said = complaint([&, text = text, frame = frame] { numbers(text, frame); });
    EXPECT_NE(said.find(reason), std::string::npos) << text << ": " << said;
  }
  ColorScheme categorical = scheme("file");
  categorical.map = ColorMap::categorical;
  const NumberFile table = read_number_file(folder.file("n", "frame,index,x\n0,0,1\n"));
  EXPECT_NE(complaint([&] { categorical.set_numbers(table); }).find("--map categorical"), std::string::npos);
}

// A scheme with numbers measured over the frames keeps them when rules take others from a file.
TEST(Colors, FluctuationsStayBesideNumbersOfAFile) {
  ColorScheme scheme;
  scheme.by = ColorScheme::By::rmsf;
  scheme.file = {.path = "run", .numbers = {1.0, 2.0}};
  scheme.rules.push_back(parse_color_rule("resid 1=file"));
  NumberFile numbers{.path = "numbers.txt", .numbers = {5.0, 6.0}};
  scheme.set_numbers(numbers);
  EXPECT_EQ(scheme.file.numbers, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(scheme.rules[0].paint.file.numbers, numbers.numbers);
  EXPECT_FALSE(scheme.uses_frames());
  numbers.by_frame = std::make_shared<const std::map<std::uint64_t, NumberFile>>();
  scheme.set_numbers(numbers);
  EXPECT_TRUE(scheme.uses_frames());
}

TEST(Colors, NumbersAreGivenForAllAtomsOrForThoseInUse) {
  Structure structure = four_atoms();
  structure.atoms.erase(structure.atoms.begin() + 1);
  structure.report.used = 3;
  structure.report.excluded[kExcludedWater] = 1;
  ColorScheme wish = scheme("file");
  wish.file = {"all", {0.0, 100.0, 1.0, 2.0}};
  EXPECT_EQ(color_scale(structure, wish).value, (std::vector<double>{0.0, 1.0, 2.0}));
  wish.file.numbers = {5.0, 6.0, 7.0};
  EXPECT_EQ(color_scale(structure, wish).value, (std::vector<double>{5.0, 6.0, 7.0}));
  structure.report.read = 9;  // with five atoms of a model that was not read
  structure.report.excluded[kExcludedModel] = 5;
  wish.file.numbers = {0.0, 100.0, 1.0, 2.0};
  EXPECT_EQ(color_scale(structure, wish).value, (std::vector<double>{0.0, 1.0, 2.0}));
  wish.file.numbers = {1.0, 2.0};
  EXPECT_EQ(complaint([&] { color_atoms(structure, wish); }),
            "all: holds 2 numbers; four holds 4 atoms, of which 3 are used; " + std::string(kNumberLayouts));
}

TEST(Colors, NumberFilesAreReadWithTheirGapsAndFaults) {
  const test::TemporaryFolder folder;
  const NumberFile good = read_number_file(folder.file("good", "# charge\n1 -2.5e-1,nan\n\n ? -\t+7 # end\n;8"));
  ASSERT_EQ(good.numbers.size(), 7u);
  EXPECT_EQ(good.numbers[1], -0.25);
  for (const int n : {2, 3, 4}) EXPECT_TRUE(std::isnan(good.numbers[n])) << n;
  EXPECT_EQ(good.numbers[5], 7.0);
  EXPECT_EQ(good.numbers[6], 8.0);
  const std::pair<const char*, const char*> bad[] = {{"1\n2\nabc\n", "bad:3: 'abc' is not a finite number"},
                                                     {"1\n inf\n", "bad:2: 'inf' is not"},
                                                     {"1e999\n", "bad:1: '1e999' is not"},
                                                     {"1 2x\n", "bad:1: '2x' is not"},
                                                     {"# nothing\n", "bad: holds no numbers"}};
  for (const auto& [text, reason] : bad) {
    const std::string path = folder.file("bad", text);
    const std::string said = complaint([&] { read_number_file(path); });
    EXPECT_NE(said.find(reason), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace meniscus
