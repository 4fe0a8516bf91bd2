// SPDX-License-Identifier: BSD-3-Clause
// Molecules from files through the C interface: options, data of each atom, errors.
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "tests/c_api/c_objects.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

using namespace test;

/// The molecule has two residues, one with two alternate locations, an ion, a water, and a second model.
constexpr std::string_view kMolecule =
    "REMARK 350 BIOMOLECULE: 1\n"
    "REMARK 350 APPLY THE FOLLOWING TO CHAINS: A\n"
    "REMARK 350   BIOMT1   1  1.000000  0.000000  0.000000        0.00000\n"
    "REMARK 350   BIOMT2   1  0.000000  1.000000  0.000000        0.00000\n"
    "REMARK 350   BIOMT3   1  0.000000  0.000000  1.000000        0.00000\n"
    "REMARK 350   BIOMT1   2  1.000000  0.000000  0.000000       20.00000\n"
    "REMARK 350   BIOMT2   2  0.000000  1.000000  0.000000        0.00000\n"
    "REMARK 350   BIOMT3   2  0.000000  0.000000  1.000000        0.00000\n"
    "MODEL        1\n"
    "ATOM      1  N   ALA A  -5       0.000   0.000   0.000  1.00 10.00      SEGA N  \n"
    "ATOM      2  CA AALA A  -5       1.458   0.000   0.000  0.60 20.00      SEGA C  \n"
    "ATOM      3  CA BALA A  -5       1.558   0.000   0.000  0.40 21.00      SEGA C  \n"
    "ATOM      4  H   ALA A  -5      -0.500   0.800   0.000  1.00 12.00      SEGA H  \n"
    "ATOM      5  N   GLY B   7C      5.000   0.000   0.000  1.00 30.00      SEGB N  \n"
    "HETATM    6 ZN    ZN A 101      30.000   0.000   0.000  1.00 15.00          ZN  \n"
    "HETATM    7  O   HOH A 201      40.000   0.000   0.000  1.00 25.00           O  \n"
    "ENDMDL\n"
    "MODEL        2\n"
    "ATOM      1  N   ALA A  -5       0.000   0.000   9.000  1.00 10.00      SEGA N  \n"
    "ENDMDL\n";

template <typename Row>
std::vector<Row> column(const StructureOf& structure, meniscus_structure_table_id which) {
  meniscus_array array{};
  EXPECT_EQ(meniscus_structure_table(structure.get(), which, &array), MENISCUS_OK) << meniscus_last_error();
  std::vector<Row> rows(array.count);
  for (std::size_t n = 0; n < rows.size(); ++n)
    std::memcpy(&rows[n], static_cast<const char*>(array.data) + n * array.stride, sizeof(Row));
  return rows;
}

std::vector<std::string> texts(const StructureOf& structure, meniscus_structure_table_id which) {
  meniscus_array array{};
  EXPECT_EQ(meniscus_structure_table(structure.get(), which, &array), MENISCUS_OK) << meniscus_last_error();
  std::vector<std::string> rows;
  for (std::size_t n = 0; n < array.count; ++n) {
    rows.emplace_back(static_cast<const char*>(array.data) + n * array.stride);
    EXPECT_LT(rows.back().size(), array.stride);
  }
  return rows;
}

meniscus_read_options reading() {
  meniscus_read_options options{};
  options.size = sizeof options;
  EXPECT_EQ(meniscus_default_read_options(&options), MENISCUS_OK);
  return options;
}

struct CStructure : ::testing::Test {
  const TemporaryFolder folder;
  const std::string path = folder.file("molecule.pdb", kMolecule);

  /// Returns the message of a refused call.
  std::string refused(const meniscus_read_options& options, meniscus_status expected) const {
    meniscus_structure* made = nullptr;
    EXPECT_EQ(meniscus_read(path.c_str(), &options, &made), expected) << meniscus_last_error();
    EXPECT_EQ(made, nullptr);
    meniscus_structure_release(made);
    return meniscus_last_error();
  }
};

TEST_F(CStructure, HasAColumnForEachThingAFileSaysOfAtoms) {
  const StructureOf structure = structure_of(path);
  using Words = std::vector<std::string>;
  EXPECT_EQ(texts(structure, MENISCUS_STRUCTURE_NAMES), (Words{"N", "CA", "H", "N"}));
  EXPECT_EQ(texts(structure, MENISCUS_STRUCTURE_RESIDUE_NAMES), (Words{"ALA", "ALA", "ALA", "GLY"}));
  EXPECT_EQ(texts(structure, MENISCUS_STRUCTURE_CHAINS), (Words{"A", "A", "A", "B"}));
  EXPECT_EQ(texts(structure, MENISCUS_STRUCTURE_SEGMENTS), (Words{"SEGA", "SEGA", "SEGA", "SEGB"}));
  EXPECT_EQ(column<std::uint8_t>(structure, MENISCUS_STRUCTURE_ELEMENTS), (std::vector<std::uint8_t>{7, 6, 1, 7}));
  EXPECT_EQ(column<std::uint32_t>(structure, MENISCUS_STRUCTURE_INDICES), (std::vector<std::uint32_t>{0, 1, 3, 4}));
  EXPECT_EQ(column<std::int32_t>(structure, MENISCUS_STRUCTURE_RESIDUE_NUMBERS),
            (std::vector<std::int32_t>{-5, -5, -5, 7}));
  EXPECT_EQ(column<char>(structure, MENISCUS_STRUCTURE_INSERTION_CODES), (std::vector<char>{' ', ' ', ' ', 'C'}));
  EXPECT_EQ(column<char>(structure, MENISCUS_STRUCTURE_ALTLOCS), (std::vector<char>{' ', 'A', ' ', ' '}));
  EXPECT_EQ(column<std::uint32_t>(structure, MENISCUS_STRUCTURE_RESIDUES), (std::vector<std::uint32_t>{0, 0, 0, 1}));
  EXPECT_EQ(column<std::int32_t>(structure, MENISCUS_STRUCTURE_MODELS), (std::vector<std::int32_t>{1, 1, 1, 1}));
  EXPECT_EQ(column<std::uint32_t>(structure, MENISCUS_STRUCTURE_COPIES), (std::vector<std::uint32_t>{0, 0, 0, 0}));
  EXPECT_EQ(column<float>(structure, MENISCUS_STRUCTURE_B_FACTORS), (std::vector<float>{10, 20, 12, 30}));
  EXPECT_EQ(column<float>(structure, MENISCUS_STRUCTURE_OCCUPANCIES), (std::vector<float>{1, 0.6f, 1, 1}));
  for (const float charge : column<float>(structure, MENISCUS_STRUCTURE_CHARGES)) EXPECT_TRUE(std::isnan(charge));
  EXPECT_EQ(column<std::uint8_t>(structure, MENISCUS_STRUCTURE_CLASSES).size(), 4u);
  EXPECT_EQ(column<double>(structure, MENISCUS_STRUCTURE_RADII), (std::vector<double>{1.55, 1.70, 1.20, 1.55}));
  using Point = std::array<double, 3>;
  EXPECT_EQ(column<Point>(structure, MENISCUS_STRUCTURE_POSITIONS)[1], (Point{1.458, 0, 0}));
  EXPECT_TRUE(texts(structure, MENISCUS_STRUCTURE_WARNINGS).empty());

  meniscus_read_report report{};
  report.size = sizeof report;
  ASSERT_EQ(meniscus_structure_report(structure.get(), &report), MENISCUS_OK);
  EXPECT_EQ(report.file, path);
  EXPECT_STREQ(report.format, "PDB");
  EXPECT_STREQ(report.radii_set, "bondi");
  EXPECT_EQ(report.read, 8u);
  EXPECT_EQ(report.atoms, 4u);
  EXPECT_EQ(report.models, 2u);
  EXPECT_NE(std::string(report.sentence).find("4 used"), std::string::npos) << report.sentence;
}

TEST_F(CStructure, ColorsAtomsByTheWordsOfTheProgram) {
  const auto structure = structure_of(path);
  const auto colors = [&](const char* scheme) {
    std::vector<float> rgb(3 * 4, -1.0f);
    EXPECT_EQ(meniscus_structure_colors(structure.get(), scheme, rgb.data()), MENISCUS_OK) << meniscus_last_error();
    return rgb;
  };
  const auto refused = [&](const char* scheme, meniscus_status status, const std::string& words) {
    std::vector<float> rgb(3 * 4, -1.0f);
    EXPECT_EQ(meniscus_structure_colors(structure.get(), scheme, rgb.data()), status) << scheme;
    EXPECT_NE(std::string(meniscus_last_error()).find(words), std::string::npos) << meniscus_last_error();
    EXPECT_EQ(rgb, std::vector<float>(3 * 4, -1.0f));
  };
  EXPECT_EQ(colors("#ff0033"), (std::vector<float>{1, 0, 0.2f, 1, 0, 0.2f, 1, 0, 0.2f, 1, 0, 0.2f}));
  const std::vector<float> by_chain = colors("chain"), by_element = colors("element");
  EXPECT_TRUE(std::equal(by_chain.begin(), by_chain.begin() + 3, by_chain.begin() + 3));
  EXPECT_FALSE(std::equal(by_chain.begin(), by_chain.begin() + 3, by_chain.begin() + 9));
  EXPECT_TRUE(std::equal(by_element.begin(), by_element.begin() + 3, by_element.begin() + 9));
  EXPECT_NE(colors("bfactor"), by_chain);
  for (const char* scheme : {"kind", "component", "buried", "rmsf", "relative-accessibility", "file"})
    refused(scheme, MENISCUS_USAGE, "needs more than the atoms of a file");
  refused("chains", MENISCUS_USAGE, "'chains' is not one of auto, ");
  refused("charge", MENISCUS_INPUT, "partial charges");
  EXPECT_EQ(column<double>(structure, MENISCUS_STRUCTURE_HYDROPATHIES), (std::vector<double>{1.8, 1.8, 1.8, -0.4}));
}

TEST_F(CStructure, TakesWhatTheOptionsSay) {
  const auto names = [&](const meniscus_read_options& options) {
    std::string all;
    for (const std::string& name : texts(structure_of(path, &options), MENISCUS_STRUCTURE_NAMES)) all += name + " ";
    return all;
  };
  meniscus_read_options options = reading();
  EXPECT_EQ(names(options), "N CA H N ");
  options.select = "chain B";
  EXPECT_EQ(names(options), "N ");
  options = reading();
  options.keep_water = options.keep_ions = 1;
  EXPECT_EQ(names(options), "N CA H N ZN O ");
  options = reading();
  options.hydrogens = MENISCUS_HYDROGENS_DROP;
  EXPECT_EQ(names(options), "N CA N ");
  options = reading();
  options.radii = "united";  // United radii contain hydrogens.
  EXPECT_EQ(names(options), "N CA N ");
  options = reading();
  options.model = 2;
  EXPECT_EQ(names(options), "N ");
  options.model = 0;
  EXPECT_EQ(names(options), "N CA H N N ");
  options = reading();
  options.altloc = "B";
  EXPECT_EQ(column<std::uint32_t>(structure_of(path, &options), MENISCUS_STRUCTURE_INDICES)[1], 2u);
  options = reading();
  options.assembly = "1";
  EXPECT_EQ(names(options), "N CA H N CA H ");
  EXPECT_EQ(texts(structure_of(path, &options), MENISCUS_STRUCTURE_CHAINS)[4], "A-2");
  EXPECT_EQ(column<std::uint32_t>(structure_of(path, &options), MENISCUS_STRUCTURE_COPIES)[4], 1u);
}

TEST_F(CStructure, LeavesLigandsOfAPolymerOutUnlessAtomsAreSelected) {
  std::string text(kMolecule);
  text.insert(text.find("ENDMDL"),
              "HETATM    8  C1  LIG A 301      50.000   0.000   0.000  1.00 25.00           C  \n");
  const std::string with_ligand = folder.file("ligand.pdb", text);
  meniscus_read_options options = reading();
  EXPECT_EQ(texts(structure_of(with_ligand, &options), MENISCUS_STRUCTURE_NAMES),
            (std::vector<std::string>{"N", "CA", "H", "N"}));
  options.select = "all";
  EXPECT_EQ(texts(structure_of(with_ligand, &options), MENISCUS_STRUCTURE_NAMES),
            (std::vector<std::string>{"N", "CA", "H", "N", "C1"}));
}

TEST_F(CStructure, TakesRadiiFromFilesAndExpressions) {
  const std::string table = folder.file("table.txt", "ALA N 1.9\n* CA 2.1\n");
  const char* const tables[] = {table.c_str()};
  const char* const overrides[] = {"element H=0.5", "chain B = 3"};
  meniscus_read_options options = reading();
  options.radii_files = tables;
  options.radii_file_count = 1;
  options.radius = overrides;
  options.radius_count = 2;
  options.hydrogens = MENISCUS_HYDROGENS_KEEP;
  EXPECT_EQ(column<double>(structure_of(path, &options), MENISCUS_STRUCTURE_RADII),
            (std::vector<double>{1.9, 2.1, 0.5, 3.0}));
}

TEST_F(CStructure, ItsAtomsAreComputedWhereTheyLie) {
  const StructureOf structure = structure_of(path);
  meniscus_atoms atoms{};
  atoms.size = sizeof atoms;
  ASSERT_EQ(meniscus_structure_atoms(structure.get(), &atoms), MENISCUS_OK);
  EXPECT_EQ(atoms.count, 4u);
  meniscus_surface* made = nullptr;
  ASSERT_EQ(meniscus_compute(computer().get(), &atoms, &made), MENISCUS_OK) << meniscus_last_error();
  const SurfaceOf surface(made);
  EXPECT_EQ(summary_of(surface).atoms, 4u);
}

TEST_F(CStructure, ErrorsNameOptionsAsTheLibraryHasThem) {
  meniscus_read_options options = reading();
  options.model = 3;
  EXPECT_EQ(refused(options, MENISCUS_INPUT), path + ": has no model 3: it holds 2 models; choose model 1 to 2");
  options = reading();
  options.select = "resname HOH and chain A and name XX";
  EXPECT_NE(refused(options, MENISCUS_INPUT).find("is selected by"), std::string::npos);
  options.select = "chain A and (";
  const std::string sentence = refused(options, MENISCUS_USAGE);
  EXPECT_TRUE(sentence.starts_with("select: ")) << sentence;
  EXPECT_NE(sentence.find("\nchain A and ("), std::string::npos) << sentence;
  options = reading();
  options.assembly = "7";
  EXPECT_EQ(refused(options, MENISCUS_INPUT), path + ": has no assembly '7'; it has 1");
  options = reading();
  options.altloc = "both";
  EXPECT_EQ(refused(options, MENISCUS_USAGE), "altloc is 'both'; it must be best, first, all or one letter");
  options = reading();
  options.radii = "amber";
  EXPECT_NE(refused(options, MENISCUS_INPUT).find("not a set of radii"), std::string::npos);
  options = reading();
  options.hydrogens = meniscus_hydrogens{3};
  EXPECT_NE(refused(options, MENISCUS_USAGE).find("hydrogens is 3"), std::string::npos);
  options = reading();
  options.unknown_element = meniscus_unknown_element{-1};
  EXPECT_NE(refused(options, MENISCUS_USAGE).find("unknown_element is -1"), std::string::npos);
  options = reading();
  options.model = -1;
  EXPECT_NE(refused(options, MENISCUS_USAGE).find("model is -1"), std::string::npos);
  const char* const overrides[] = {"element H"};
  options = reading();
  options.radius = overrides;
  options.radius_count = 1;
  EXPECT_TRUE(refused(options, MENISCUS_USAGE).starts_with("radius: a radius is missing"));
  const char* const nothing[] = {nullptr};
  options.radius = nothing;
  EXPECT_EQ(refused(options, MENISCUS_USAGE), "radius[0] is NULL");
}

TEST_F(CStructure, NoMessageNamesAnOptionOfTheCommandLine) {
  const auto said = [&](const std::string& name, std::string_view text, const meniscus_read_options& options) {
    meniscus_structure* made = nullptr;
    EXPECT_EQ(meniscus_read(folder.file(name, text).c_str(), &options, &made), MENISCUS_INPUT) << name;
    return std::string(meniscus_last_error());
  };
  const std::string water = "HETATM    7  O   HOH A 201      40.000   0.000   0.000  1.00 25.00           O  \n";
  EXPECT_NE(said("water.pdb", water, reading()).find("add keep_water or keep_ions to use them"), std::string::npos);
  const std::string odd = "ATOM      1  ?1  XYZ A   1       0.000   0.000   0.000  1.00 10.00              \n";
  EXPECT_NE(said("odd.pdb", odd, reading()).find("choose unknown_element=guess or skip"), std::string::npos);
  meniscus_read_options options = reading();
  options.assembly = "1";
  const std::string bare(kMolecule.substr(kMolecule.find("MODEL")));
  EXPECT_TRUE(said("bare.pdb", bare, options).ends_with("leave assembly out")) << meniscus_last_error();
  EXPECT_TRUE(said("balls.xyzr", "0 0 0 1.5\n", options).ends_with("leave assembly out")) << meniscus_last_error();
}

TEST_F(CStructure, StandardInputIsLeftAlone) {
  meniscus_structure* made = nullptr;
  EXPECT_EQ(meniscus_read("-", nullptr, &made), MENISCUS_INPUT);
  EXPECT_TRUE(std::string(meniscus_last_error()).starts_with("./-: cannot be read")) << meniscus_last_error();
}

TEST_F(CStructure, OddThingsInTheFileAreTold) {
  const std::string twice =
      folder.file("twice.pdb",
                  "ATOM      1  N   ALA A   1       0.000   0.000   0.000  1.00 10.00           N  \n"
                  "ATOM      2  CA  ALA A   1       0.000   0.000   0.000  1.00 10.00           C  \n");
  EXPECT_EQ(texts(structure_of(twice), MENISCUS_STRUCTURE_WARNINGS).size(), 1u);
}

}  // namespace
}  // namespace meniscus
