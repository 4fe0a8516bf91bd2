// SPDX-License-Identifier: BSD-3-Clause
// Radii by set, table and override: values of atoms, atoms that are left out, messages; FreeSASA's tables agree.
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/structure/formats/read_structure.h"
#include "core/structure/radii/assign_radii.h"
#include "core/structure/residue_names.h"
#include "tests/support/run_program.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

using test::TemporaryFolder;

constexpr const char* kUbiquitinNmr = "/usr/share/freesasa/test-data/1d3z.pdb";
constexpr const char* kToxin = "/usr/share/pymol/test/dat/1tii.pdb";

Atom atom_of(const char* residue, const char* name, int element = 6) {
  Atom atom;
  atom.residue_name = residue;
  atom.name = name;
  atom.element = static_cast<std::uint8_t>(element);
  return atom;
}

double radius_in(const RadiiTable& table, const char* residue, const char* name, bool hydrogens = false) {
  const auto found = table.find(atom_of(residue, name), hydrogens);
  return found ? found->radius : -1.0;
}

RadiiTable table_of(std::string_view content) {
  const TemporaryFolder folder;
  std::vector<RadiiTable> tables = read_radii_files({folder.file("radii.txt", content)});
  EXPECT_EQ(tables.size(), 1u);
  return tables.front();
}

Structure read_with(const char* file, const RadiiOptions& radii, Hydrogens hydrogens = Hydrogens::automatic) {
  ReadOptions options;
  options.radii = radii;
  options.hydrogens = hydrogens;
  return read_structure(file, options);
}

TEST(RadiiSets, AreNamedAndGiveTheirSource) {
  EXPECT_EQ(radii_set_names(), "bondi, united, protor, martini2, martini3, file");
  for (const RadiiSet* set : radii_sets()) {
    EXPECT_EQ(find_radii_set(set->name), set);
    EXPECT_FALSE(set->description.empty() || set->source.empty());
  }
  EXPECT_EQ(find_radii_set("Bondi"), nullptr);
}

TEST(RadiiSets, BondingClassesKnowTheirResiduesByAnyName) {
  EXPECT_EQ(bonding_class("TRP", "CZ3"), "C3H1");
  EXPECT_EQ(bonding_class("HSE", "ND1"), "N3H1");
  EXPECT_EQ(bonding_class("ILE", "CD"), "C4H3");
  EXPECT_EQ(bonding_class("DA5", "C2'"), "C4H2");
  EXPECT_EQ(bonding_class("RG", "O2*"), "O2H1");
  EXPECT_EQ(bonding_class("TIP3", "OH2"), "O2H2");
  EXPECT_EQ(bonding_class("GLY", "CA"), "C4H2");
  EXPECT_EQ(bonding_class("GLY", "CB"), "");
  EXPECT_EQ(bonding_class("ATP", "C2"), "");
}

/// Compares the program's set with FreeSASA's table, for every heavy atom of real files.
void expect_as_in_freesasa(const char* set, const char* config, std::size_t least) {
  const RadiiTable table = read_radii_files({config}).front();
  std::size_t compared = 0;
  for (const char* file : {kUbiquitin, kToxin}) {
    for (const Atom& atom : read_with(file, {.set = set}).atoms) {
      const auto expected = table.find(atom, false);
      ASSERT_TRUE(expected) << label_of(atom);
      EXPECT_EQ(atom.radius, expected->radius) << label_of(atom);
      ++compared;
    }
  }
  EXPECT_GE(compared, least);
}

TEST(RadiiSets, ProtorIsFreesasas) {
  expect_as_in_freesasa("protor", "/usr/share/freesasa/protor.config", 6071);
  const RadiiTable table = read_radii_files({"/usr/share/freesasa/protor.config"}).front();
  for (const char* residue : {"A", "C", "G", "U", "DA", "DC", "DG", "DT", "I", "DI", "MSE", "SEC"}) {
    for (const char* name : {"P",  "OP1", "OP2", "O5'", "C5'", "C4'", "O4'", "C3'", "O3'", "C2'", "O2'", "C1'", "N9",
                             "C8", "N7",  "C5",  "C6",  "N6",  "N1",  "C2",  "N3",  "C4",  "O6",  "N2",  "O2",  "N4",
                             "O4", "C7",  "N",   "CA",  "C",   "O",   "CB",  "CG",  "SE",  "CE",  "OXT"}) {
      const auto expected = table.find(atom_of(residue, name), false);
      const auto found = kProtorSet.radius_of(atom_of(residue, name));
      if (expected) {
        ASSERT_TRUE(found) << residue << " " << name;
        EXPECT_EQ(found->radius, expected->radius) << residue << " " << name;
      }
    }
  }
}

TEST(RadiiSets, UnitedIsChothiasAsInNaccess) {
  expect_as_in_freesasa("united", "/usr/share/freesasa/naccess.config", 6071);
}

TEST(RadiiSets, HydrogensAreDroppedWhereRadiiContainThem) {
  const Structure bondi = read_with(kUbiquitinNmr, {});
  EXPECT_EQ(bondi.atoms.size(), 1231u);
  EXPECT_EQ(bondi.radii_set, "bondi");
  EXPECT_FALSE(bondi.report.excluded.contains(kExcludedHydrogen));

  const Structure protor = read_with(kUbiquitinNmr, {.set = "protor"});
  EXPECT_EQ(protor.atoms.size(), 602u);
  EXPECT_EQ(protor.report.excluded.at(kExcludedHydrogen), 629u);
  EXPECT_TRUE(protor.report.warnings.empty());

  const Structure mixed = read_with(kUbiquitinNmr, {.set = "protor"}, Hydrogens::keep);
  EXPECT_EQ(mixed.atoms.size(), 1231u);
  ASSERT_EQ(mixed.report.warnings.size(), 2u);
  EXPECT_NE(mixed.report.warnings[0].text.find("protor gives no radius to 629 atoms"), std::string::npos);
  EXPECT_NE(mixed.report.warnings[1].text.find("629 hydrogens are used with radii of united atoms"), std::string::npos);

  EXPECT_EQ(read_with(kUbiquitinNmr, {}, Hydrogens::drop).atoms.size(), 602u);
}

TEST(RadiiSets, TheAccountAddsUp) {
  const Structure structure = read_with(kUbiquitinNmr, {.set = "protor"});
  std::size_t atoms = 0;
  for (const RadiusClass& row : structure.radius_classes) atoms += row.atoms;
  EXPECT_EQ(atoms, structure.atoms.size());
  EXPECT_EQ(structure.report.used, atoms);
}

TEST(RadiiOverrides, LaterOnesWin) {
  const auto structure = read_with(
      kUbiquitin, {.overrides = {parse_radius_override("name CA CB=2.5"), parse_radius_override("name CB=1")}});
  for (const Atom& atom : structure.atoms) {
    if (atom.name == "CA") {
      EXPECT_EQ(atom.radius, 2.5);
    }
    if (atom.name == "CB") {
      EXPECT_EQ(atom.radius, 1.0);
    }
    if (atom.name == "C") {
      EXPECT_EQ(atom.radius, 1.7);
    }
  }
  const auto idle = read_with(kUbiquitin, {.overrides = {parse_radius_override("chain Q=1")}});
  ASSERT_EQ(idle.report.warnings.size(), 1u);
  EXPECT_NE(idle.report.warnings[0].text.find("no atom is selected by 'chain Q'"), std::string::npos);
}

TEST(RadiiOverrides, AreReadStrictly) {
  EXPECT_EQ(parse_radius_override("b = 5=1.25").radius, 1.25);
  for (const char* bad : {"", "all", "all=", "all=0", "all=-1", "all=nan", "all=1e9", "all=1.5x", "=1.5", "nam CA=1"}) {
    EXPECT_THROW(parse_radius_override(bad), SelectionError) << bad;
  }
}

TEST(RadiiTables, AtomTypesTakeTheFirstPatternAndTheColumnThatFits) {
  const RadiiTable table = table_of(
      "# residue atom key\nradius 1 0.57 1.40\nradius 2 0.66 1.40 1.60\nradius 15 0.37 1.20  # hydrogen\n"
      "* [0-9]*H.* 15\nWAT|HOH O.* 2\nASP OD[12][AB]? 1\n* CD__ 2\n* O 1\n");
  EXPECT_EQ(radius_in(table, "HOH", "OW"), 1.6);
  EXPECT_EQ(radius_in(table, "HOH", "OW", true), 1.4);
  EXPECT_EQ(radius_in(table, "ASP", "OD2A"), 1.4);
  EXPECT_EQ(radius_in(table, "ASP", "OD3"), -1.0);
  EXPECT_EQ(radius_in(table, "XXX", "CD"), 1.6);
  EXPECT_EQ(radius_in(table, "XXX", "2HB"), 1.2);
  EXPECT_FALSE(table.united());
}

TEST(RadiiTables, NamePatternsAreThoseOfAwk) {
  EXPECT_TRUE(NamePattern("*").matches(""));
  EXPECT_TRUE(NamePattern("*").matches("anything"));
  EXPECT_TRUE(NamePattern("[0-9]*H.*").matches("12HB"));
  EXPECT_FALSE(NamePattern("[0-9]*H.*").matches("CH"));
  EXPECT_TRUE(NamePattern("A|G|URI").matches("URI"));
  EXPECT_FALSE(NamePattern("A|G|URI").matches("AG"));
  EXPECT_TRUE(NamePattern("C[12345]\\*").matches("C3*"));
  EXPECT_FALSE(NamePattern("C[12345]\\*").matches("C33"));
  EXPECT_TRUE(NamePattern("C[^A-D]+").matches("CXYZ"));
  EXPECT_FALSE(NamePattern("C[^A-D]+").matches("C"));
  std::string hard;
  for (int n = 0; n < 60; ++n) hard += "a*";
  EXPECT_FALSE(NamePattern(hard + "b").matches(std::string(60, 'a')));  // The match returns soon.
  for (const char* bad : {"(a)", "[a", "a\\", "*a", "a{2}", "^a", "a$"}) EXPECT_THROW(NamePattern{bad}, Error) << bad;
}

TEST(RadiiTables, ListsAndForceFieldsGoByName) {
  const RadiiTable list = table_of("# mine\nALA CB 2.1\n* CB 2.0\nANY CA 1.9\nHSE NE2 1.5\n");
  EXPECT_EQ(radius_in(list, "ALA", "CB"), 2.1);
  EXPECT_EQ(radius_in(list, "GLU", "CB"), 2.0);
  EXPECT_EQ(radius_in(list, "GLU", "CA"), 1.9);
  EXPECT_EQ(radius_in(list, "HIS", "NE2"), 1.5);
  EXPECT_EQ(radius_in(list, "GLU", "CG"), -1.0);
  EXPECT_TRUE(list.united());
  const RadiiTable field =
      table_of("ALA N -0.4157 1.824 N\nALA H 0.2719 0.6 H\nALA HB1 0.0603 1.487\nNALA H2 0.1 0.5\n");
  EXPECT_EQ(radius_in(field, "ALA", "N"), 1.824);
  EXPECT_EQ(radius_in(field, "ALA", "HN"), 0.6);
  EXPECT_EQ(radius_in(field, "ALA", "HB3"), 1.487);
  EXPECT_EQ(radius_in(field, "ALA", "H2"), 0.5);
  EXPECT_FALSE(field.united());
}

constexpr const char* kTopology =
    "* title\n36 1\nMASS 1 H 1.008 H\nRESI ALA 0.00\nGROUP\nATOM N NH1 -0.47 ! amide\nATOM HN H 0.31\nATOM CB CT3 "
    "-0.27\n"
    "BOND CB CA\nPRES NTER 1.00\nATOM N NH3 -0.30\nATOM HT1 HC 0.33\nEND\n";
constexpr const char* kParameters =
    "* title\nBONDS\nCT3 NH1 320.0 1.43\nNONBONDED nbxmod 5 atom cdiel -\ncutnb 14.0 ctofnb 12.0 eps 1.0\n"
    "! comment\nNH1 0.0 -0.20 1.85 0.0 -0.2 1.55\nNH3 0.0 -0.20 1.85\nH 0.0 -0.046 0.2245\nHC 0 -0.046 0.2245\n"
    "CT3 0.0 -0.08 2.06\nNBFIX\nSOD CLA -0.083 3.731\nEND\n";

TEST(RadiiTables, CharmmJoinsTopologyAndParameters) {
  const TemporaryFolder folder;
  const std::string topology = folder.file("a.rtf", kTopology), parameters = folder.file("a.prm", kParameters);
  for (const auto& paths : {std::vector{topology, parameters}, std::vector{parameters, topology}}) {
    const std::vector<RadiiTable> tables = read_radii_files(paths);
    ASSERT_EQ(tables.size(), 1u);
    EXPECT_EQ(radius_in(tables[0], "ALA", "N"), 1.85);
    EXPECT_EQ(radius_in(tables[0], "ALA", "H"), 0.2245);
    EXPECT_EQ(radius_in(tables[0], "ALA", "CB"), 2.06);
    EXPECT_EQ(radius_in(tables[0], "ALA", "HT1"), 0.2245);  // Only a patch names it.
    EXPECT_EQ(radius_in(tables[0], "GLY", "N"), -1.0);
    EXPECT_FALSE(tables[0].united());
  }
  EXPECT_THROW(read_radii_files({topology}), InputError);
  EXPECT_THROW(read_radii_files({parameters}), InputError);
  const std::string both = folder.file(
      "a.str", std::string("read rtf card append\n") + kTopology + "read para card flex append\n" + kParameters);
  EXPECT_EQ(radius_in(read_radii_files({both})[0], "ALA", "CB"), 2.06);
}

TEST(RadiiTables, MistakesNameFileAndLine) {
  const std::pair<const char*, const char*> cases[] = {
      {"hello world\n", "is not a table of radii"},
      {"ALA CB x\n", ":1:"},
      {"ALA CB 2\nALA CG -1\n", ":2:"},
      {"ALA CB nan\n", ":1:"},
      {"ALA CB 1e9\n", ":1:"},
      {"ALA N 0.1 1.8\nALA C\n", ":2: has 2 fields"},
      {"types:\nC 1.8\natoms:\nALA CB D\n", ":4: 'D' is not one of its types"},
      {"atoms:\nALA CB\n", ":2:"},
      {"types:\nC 1.8\natoms:\n", "gives no atom a radius"},
      {"radius 1 0.5 1.4\nALA CB 2\n", ":2: type '2' has no radius line"},
      {"radius 1 0.5 1.4\nALA C( 1\n", ":2: the pattern"},
      {"RESI ALA 0.0\nATOM N\n", ":2: an ATOM needs"},
      {"NONBONDED\nC 0.0 -0.1\n", ":2: a line of NONBONDED"},
  };
  const TemporaryFolder folder;
  for (const auto& [content, message] : cases) {
    try {
      read_radii_files({folder.file("bad.txt", content)});
      ADD_FAILURE() << "read: " << content;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }
}

TEST(RadiiTables, UncoveredAtomsFallBackAndAreCounted) {
  const TemporaryFolder folder;
  const std::string list = folder.file("list.txt", "* CA 2.5\n* HA 0.0\n");
  const Structure structure = read_with(kUbiquitinNmr, {.files = {list}});
  EXPECT_EQ(structure.radii_set, list);
  ASSERT_EQ(structure.report.warnings.size(), 1u);
  EXPECT_NE(structure.report.warnings[0].text.find("gives no radius to"), std::string::npos);
  EXPECT_GT(structure.report.excluded.at(kExcludedRadius), 60u);  // Alpha hydrogens have no ball.
  for (const Atom& atom : structure.atoms) {
    EXPECT_NE(atom.name, "HA");
    if (atom.name == "CA") {
      EXPECT_EQ(atom.radius, 2.5);
    }
    if (atom.name == "CB") {
      EXPECT_EQ(atom.radius, 1.7);
    }
  }
  EXPECT_THROW(read_with(kUbiquitin, {.set = "file"}), InputError);
  EXPECT_THROW(read_with(kUbiquitin, {.set = "alvarez"}), InputError);
}

TEST(RadiiSets, WhichCoverNothingAreRefused) {
  const TemporaryFolder folder;
  const std::string ligand = folder.file("a.xyz", "2\n\nC 0 0 0\nO 1.4 0 0\n"),
                    others = folder.file("list.txt", "ZZZ CA 2.5\n");
  const auto message = [](const std::string& file, const RadiiOptions& radii) -> std::string {
    try {
      read_with(file.c_str(), radii);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  for (const char* set : {"martini2", "martini3"})
    EXPECT_NE(message(kUbiquitin, {.set = set}).find(std::string(set) + " has a radius for none of its 660 atoms"),
              std::string::npos)
        << message(kUbiquitin, {.set = set});
  for (const char* set : {"united", "protor"})
    EXPECT_NE(message(ligand, {.set = set}).find("has a radius for none of its 2 atoms"), std::string::npos) << set;
  EXPECT_NE(message(kUbiquitin, {.files = {others}}).find("list.txt has a radius for none"), std::string::npos);
  EXPECT_EQ(message(ligand, {.set = "united", .may_cover_none = true}), "");
  EXPECT_EQ(message(ligand, {.set = "united", .overrides = {parse_radius_override("all=2")}}), "");
}

TEST(RadiiTables, OfAtomTypesFollowTheHydrogens) {
  const TemporaryFolder folder;
  const std::string types = folder.file("types", "radius 1 0.7 1.5 1.8\nradius 15 0.37 1.2\n* H.* 15\n* .* 1\n");
  EXPECT_EQ(read_with(kUbiquitinNmr, {.files = {types}}).atoms.front().radius, 1.5);
  EXPECT_EQ(read_with(kUbiquitinNmr, {.files = {types}}, Hydrogens::drop).atoms.front().radius, 1.8);
  EXPECT_EQ(read_with(kUbiquitin, {.files = {types}}).atoms.front().radius, 1.8);
}

}  // namespace
}  // namespace meniscus
