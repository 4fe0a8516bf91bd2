// SPDX-License-Identifier: BSD-3-Clause
// Classes of confidence, of secondary structure, of sugars and of beads, and places in chains: from files, with their
// gaps and doubts.
#include "core/color/ordered_classes.h"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/color/color_key.h"
#include "core/color/color_schemes.h"
#include "core/color/named_colors.h"
#include "core/structure/formats/read_structure.h"
#include "tests/support/run_program.h"
#include "tests/unit/color/colored_atoms.h"

namespace meniscus {
namespace {

constexpr std::uint32_t kVeryHigh = 0x0053d6, kConfident = 0x65cbf3, kLow = 0xffdb13, kVeryLow = 0xff7d45;

std::vector<glm::vec3> colors_of_hex(const std::vector<std::uint32_t>& hex) {
  std::vector<glm::vec3> colors;
  for (const std::uint32_t color : hex) colors.push_back(color_from_hex(color));
  return colors;
}

Structure with_b_factors(const std::array<float, 4>& numbers) {
  Structure structure = four_atoms();
  for (std::size_t a = 0; a < 4; ++a) structure.atoms[a].b_factor = numbers[a];
  return structure;
}

/// Returns four alpha carbons of residues 1 to 4 of label chain A, with author's numbers X 11 to 14; B-factors of 99.
std::string model_cif(const std::string& metrics) {
  std::string text =
      "data_m\n" + metrics +
      "loop_\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.label_atom_id\n_atom_site.label_comp_id\n"
      "_atom_site.label_asym_id\n_atom_site.label_seq_id\n_atom_site.auth_asym_id\n_atom_site.auth_seq_id\n"
      "_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.B_iso_or_equiv\n";
  for (int n = 1; n <= 4; ++n) text += fmt::format("{} C CA GLY A {} X {} {} 0 0 99\n", n, n, n + 10, 4 * n);
  return text;
}

std::string metric(const std::string& type, const std::string& rows) {
  return "loop_\n_ma_qa_metric.id\n_ma_qa_metric.mode\n_ma_qa_metric.name\n_ma_qa_metric.type\n"
         "1 global pLDDT pLDDT\n2 local other zscore\n3 local pLDDT '" +
         type +
         "'\nloop_\n_ma_qa_metric_local.ordinal_id\n_ma_qa_metric_local.model_id\n_ma_qa_metric_local.label_asym_id\n"
         "_ma_qa_metric_local.label_seq_id\n_ma_qa_metric_local.metric_id\n_ma_qa_metric_local.metric_value\n" +
         rows;
}

Structure read_text(const char* name, const std::string& text) {
  const test::TemporaryFolder folder;
  ReadOptions reading;
  reading.selection = parse_selection("all");
  return read_structure(folder.file(name, text), reading);
}

TEST(Sugars, HaveTheColoursOfTheirSymbols) {
  const auto line = [](int serial, const char* name, const char* residue, int number, double x, double y,
                       char element) {
    return fmt::format("HETATM{:5}  {:<3} {:>3} A{:4}    {:8.3f}{:8.3f}{:8.3f}  1.00  0.00           {}  \n", serial,
                       name, residue, number, x, y, 0.0, element);
  };
  std::string text;
  int serial = 0;
  for (const char* residue : {"NAG", "GCU", "ATP"}) {
    const char* names[] = {"C1", "C2", "C3", "C4", "C5", "O5", "C6"};
    const int number = serial;
    for (int n = 0; n < 7; ++n, ++serial)
      text +=
          line(serial + 1, names[n], residue, number + 1, 20.0 * number + (n < 6 ? 1.4 : 2.9) * std::cos(1.0472 * n),
               (n < 6 ? 1.4 : 2.9) * std::sin(1.0472 * n), names[n][0]);
  }
  const Structure structure = read_text("sugars.pdb", text);
  const std::vector<glm::vec3> colors = colored("snfg", structure).atom;
  EXPECT_EQ(colors[0], color_from_hex(0x0090bc));
  EXPECT_EQ(colors[6], color_from_hex(0x0090bc));   // NAG has a single colour.
  EXPECT_EQ(colors[7], color_from_hex(0x0090bc));   // the ring of GCU
  EXPECT_EQ(colors[13], color_from_hex(0xf5f5f5));  // The white half lies beyond the ring.
  EXPECT_EQ(colors[14], color_from_hex(0xb4b4b4));
  const ColorKey key = color_key(structure, scheme("snfg"), {});
  ASSERT_EQ(key.classes.size(), 4u);
  EXPECT_EQ(key.classes[0].name, "GlcNAc");
  EXPECT_EQ(key.classes[1].name, "GlcA");
}

TEST(Beads, AreClassedByTheirTypes) {
  std::string text = "beads\n    7\n";
  int serial = 0;
  for (const auto& [residue, name] : std::initializer_list<std::pair<const char*, const char*>>{{"1ALA  ", "   BB"},
                                                                                                {"1ALA  ", "  SC1"},
                                                                                                {"2POPC ", "  NC3"},
                                                                                                {"2POPC ", "  PO4"},
                                                                                                {"2POPC ", "  GL1"},
                                                                                                {"2POPC ", "  C1A"},
                                                                                                {"2POPC ", "  D2A"}}) {
    ++serial;
    text += fmt::format("    {}{}{:5}{:8.3f}{:8.3f}{:8.3f}\n", residue, name, serial, 0.5 * serial, 0.0, 0.0);
  }
  const Structure structure = read_text("beads.gro", text + " 9.0 9.0 9.0\n");
  const ColorKey key = color_key(structure, scheme("bead"), {});
  std::vector<std::string> names;
  for (const ColorClass& each : key.classes) names.push_back(each.name);
  EXPECT_EQ(names, (std::vector<std::string>{"charged", "polar", "intermediate", "apolar"}));
  const std::vector<glm::vec3> colors = colored("bead", structure).atom;
  EXPECT_EQ(colors, colors_of_hex({0x56b4e9, 0xe6d9b8, 0xd55e00, 0xd55e00, 0x009e73, 0xe6d9b8, 0xe6d9b8}));
}

TEST(Confidence, HasTheFourClassesOfAlphaFold) {
  EXPECT_EQ(colored("plddt", with_b_factors({95.0f, 80.0f, 60.0f, 30.0f})).atom,
            colors_of_hex({kVeryHigh, kConfident, kLow, kVeryLow}));
  // A number on a limit is in the class below.
  EXPECT_EQ(colored("plddt", with_b_factors({90.01f, 90.0f, 70.0f, 50.0f})).atom,
            colors_of_hex({kVeryHigh, kConfident, kLow, kVeryLow}));
  const ColorKey key = color_key(with_b_factors({95.0f, 95.0f, 95.0f, kNan}), scheme("plddt"), {});
  ASSERT_EQ(key.classes.size(), 2u) << "those that occur";
  EXPECT_EQ(key.classes[0].color, color_from_hex(kVeryHigh));
  EXPECT_EQ(key.classes[1].name, "none (1 atoms)");
  EXPECT_FALSE(key.scale);
  EXPECT_NE(complaint([] {
              colored("plddt", with_b_factors({kNan, kNan, kNan, kNan}));
            }).find("no pLDDT"),
            std::string::npos);
}

TEST(Confidence, OfModelCifCountsBeforeBFactors) {
  const std::string rows = "1 1 A 1 3 30\n2 1 A 2 3 60\n3 1 A 3 3 91.5\n4 1 A 4 2 12\n5 2 A 4 3 12\n";
  const Structure structure = read_text("m.cif", model_cif(metric("pLDDT", rows)));
  EXPECT_EQ(source_of_confidence(structure), "_ma_qa_metric_local");
  EXPECT_FALSE(doubt_of_confidence(structure));
  EXPECT_EQ(colored("plddt", structure).atom, colors_of_hex({kVeryLow, kLow, kVeryHigh, 0x808080}))
      << "another metric and another model are not those of residue 4";
  const Structure shares = read_text("m.cif", model_cif(metric("pLDDT in [0,1]", "1 1 A 1 3 0.8\n")));
  EXPECT_FLOAT_EQ(shares.atoms[0].confidence, 80.0f);
  const Structure without = read_text("m.cif", model_cif(""));
  EXPECT_EQ(source_of_confidence(without), "B-factors");
  EXPECT_EQ(colored("plddt", without).atom[0], color_from_hex(kVeryHigh));
}

TEST(Confidence, OfOtherNumbersIsDoubted) {
  const auto doubt = [](const Structure& structure) { return doubt_of_confidence(structure).value_or(""); };
  EXPECT_EQ(doubt(with_b_factors({0.0f, 50.0f, 100.0f, kNan})), "");
  EXPECT_NE(doubt(with_b_factors({10.0f, 120.5f, -3.0f, 20.0f})).find("2 atoms are outside this range (first"),
            std::string::npos);
  EXPECT_NE(doubt(with_b_factors({10.0f, 120.5f, -3.0f, 20.0f})).find("with 120.5"), std::string::npos);
  EXPECT_NE(doubt(with_b_factors({0.9f, 0.8f, 0.3f, 1.0f})).find("all are at most 1"), std::string::npos);
  const char* const atom = "ATOM      1  CA  GLY A   1       0.000   0.000   0.000  1.00 20.00           C\n";
  EXPECT_NE(doubt(read_text("m.pdb", std::string("EXPDTA    X-RAY DIFFRACTION\n") + atom)).find("(X-RAY DIFFRACTION)"),
            std::string::npos);
  EXPECT_EQ(doubt(read_text("m.pdb", std::string("EXPDTA    THEORETICAL MODEL\n") + atom)), "");
  EXPECT_NE(doubt(read_text("m.cif", model_cif("_exptl.method 'SOLUTION NMR'\n"))).find("(SOLUTION NMR)"),
            std::string::npos);
  EXPECT_EQ(doubt(read_text("m.cif", model_cif("_exptl.method 'THEORETICAL MODEL'\n"))), "");
}

TEST(SecondaryClasses, AreThoseThatOccurInTheirOrder) {
  Structure structure = four_atoms();
  structure.atoms[0].secondary = SecondaryStructure::coil;
  structure.atoms[1].secondary = SecondaryStructure::helix;
  structure.atoms[2].secondary = SecondaryStructure::coil;
  structure.atoms[3].secondary = SecondaryStructure::coil;  // It belongs to residue UNX.
  const ColorKey key = color_key(structure, scheme("secondary"), {});
  ASSERT_EQ(key.classes.size(), 3u);
  EXPECT_EQ(key.classes[0].name, "helix");
  EXPECT_EQ(key.classes[1].name, "coil");
  EXPECT_EQ(key.classes[2].name, "other");
  const Coloring coloring = colored("secondary", structure);
  EXPECT_EQ(coloring.atom[1], key.classes[0].color);
  EXPECT_EQ(coloring.atom[0], key.classes[1].color);
  EXPECT_EQ(coloring.atom[2], coloring.atom[0]);
  EXPECT_EQ(coloring.atom[3], key.classes[2].color);
  structure.atoms[0].secondary = SecondaryStructure::strand;
  EXPECT_EQ(color_key(structure, scheme("secondary"), {}).classes[1].name, "strand");
}

/// Returns residues 0 to 3 of chain A, of which 3 is a ligand, and 4 and 5 of chain B.
Structure two_chains() {
  Structure structure;
  structure.file = "two";
  for (std::uint32_t residue = 0; residue < 6; ++residue) {
    Atom& atom = structure.atoms.emplace_back();
    atom.residue = residue;
    atom.chain = residue < 4 ? "A" : "B";
    atom.kind = residue == 3 ? AtomClass::ligand : AtomClass::polymer;
    atom.name = "CA";
  }
  return structure;
}

TEST(Rainbow, GoesFromTheFirstResidueOfEachChainToItsLast) {
  Structure structure = two_chains();
  const ColorScale scale = color_scale(structure, scheme("rainbow"));
  const std::vector<double> wanted{0.0, 0.5, 1.0, NAN, 0.0, 1.0};
  for (std::size_t a = 0; a < wanted.size(); ++a) {
    if (std::isnan(wanted[a]))
      EXPECT_TRUE(std::isnan(scale.value[a]));
    else
      EXPECT_EQ(scale.value[a], wanted[a]) << a;
  }
  EXPECT_EQ(scale.color(0.0), color_from_hex(0x0072b2));
  EXPECT_EQ(scale.color(1.0), color_from_hex(0xd55e00));
  EXPECT_EQ(scale.ends, (std::array<std::string, 2>{"N", "C"}));
  for (Atom& atom : structure.atoms) atom.name = "C4'";
  EXPECT_EQ(color_scale(structure, scheme("rainbow")).ends[0], "5′");
  structure.atoms[4].name = "CA";
  EXPECT_EQ(color_scale(structure, scheme("rainbow")).ends[1], "C or 3′");
  ColorScheme half = scheme("rainbow");
  half.range = {{0.0, 0.5}};
  EXPECT_EQ(color_scale(structure, half).ends[0], "") << "0.5 is no end of a chain";
  // Atoms outside of the surface belong to the same chain.
  structure.extra_atoms.push_back(structure.atoms[2]);
  structure.extra_atoms.back().residue = 9;
  EXPECT_NEAR(color_scale(structure, scheme("rainbow")).value[2], 2.0 / 3.0, 1e-12);
  for (Atom& atom : structure.atoms) atom.kind = AtomClass::ligand;
  structure.extra_atoms.clear();
  EXPECT_NE(complaint([&] { colored("rainbow", structure); }).find("no chains of amino acids"), std::string::npos);
}

TEST(Conservation, TakesTheNineGradesOfConsurf) {
  ColorScheme wish = scheme("conservation");
  wish.file = {"grades", {1.0, 5.0, 9.0, NAN}};
  const ColorScale scale = color_scale(four_atoms(), wish);
  EXPECT_EQ(scale.range, (std::array<double, 2>{1.0, 9.0}));
  EXPECT_EQ(scale.steps(), 9u);
  EXPECT_EQ(scale.ends[1], "conserved");
  EXPECT_EQ(color_atoms(four_atoms(), wish).atom, colors_of_hex({0x10c8d1, 0xffffff, 0xa02560, 0xffff96}));
  wish.file.numbers[1] = -0.7;
  EXPECT_NE(complaint([&] { color_scale(four_atoms(), wish); }).find("grades: holds -0.7; --color conservation takes"),
            std::string::npos);
  EXPECT_TRUE(wish.uses_file() && wish.takes_file());
}

}  // namespace
}  // namespace meniscus
