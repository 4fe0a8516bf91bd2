// SPDX-License-Identifier: BSD-3-Clause
// Martini's beads: never taken for the elements that their names look like, with the radii of their version, and
// bonded.
#include "core/structure/martini.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/structure/bonds.h"
#include "core/structure/formats/read_structure.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

using test::TemporaryFolder;

struct Row {
  int residue;
  std::string residue_name, name;
};

/// Returns a GRO file whose beads are in a row, 3 Å apart.
std::string gro(const std::vector<Row>& rows) {
  std::string text = fmt::format("beads\n{:5}\n", rows.size());
  for (std::size_t n = 0; n < rows.size(); ++n)
    text += fmt::format("{:5}{:<5}{:>5}{:5}{:8.3f}{:8.3f}{:8.3f}\n", rows[n].residue, rows[n].residue_name,
                        rows[n].name, n + 1, 0.3 * static_cast<double>(n), 0.0, 0.0);
  return text + "  50.0 50.0 50.0\n";
}

const std::vector<Row> kLipid{{1, "POPC", "NC3"}, {1, "POPC", "PO4"}, {1, "POPC", "GL1"}, {1, "POPC", "GL2"},
                              {1, "POPC", "C1A"}, {1, "POPC", "D2A"}, {1, "POPC", "C1B"}, {1, "POPC", "C2B"}};

std::vector<Row> with(std::vector<Row> rows, const std::vector<Row>& more) {
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

Structure read(const std::vector<Row>& rows, const std::string& radii = "") {
  const TemporaryFolder folder;
  ReadOptions options;
  options.keep_water = options.keep_ions = options.takes_ligands = true;
  options.radii.set = radii;
  return read_structure(folder.file("beads.gro", gro(rows)), options);
}

std::map<std::string, double> radii_of(const Structure& structure) {
  std::map<std::string, double> radii;
  for (const Atom& atom : structure.atoms) radii[atom.name] = std::round(1000.0 * atom.radius) / 1000.0;
  return radii;
}

TEST(Martini, BeadsHaveNoElementWhateverTheyAreCalled) {
  const Structure structure =
      read(with(kLipid, {{2, "ALA", "BB"}, {2, "ALA", "SC1"}, {3, "W", "W"}, {4, "ION", "NA+"}, {5, "ION", "CL-"}}));
  for (const Atom& atom : structure.atoms) EXPECT_EQ(atom.element, 0) << atom.name;
  std::map<std::string, AtomClass> kinds;
  for (const Atom& atom : structure.atoms) kinds[atom.residue_name] = atom.kind;
  EXPECT_EQ(kinds["POPC"], AtomClass::ligand);
  EXPECT_EQ(kinds["ALA"], AtomClass::polymer);
  EXPECT_EQ(kinds["W"], AtomClass::water);
  EXPECT_EQ(kinds["ION"], AtomClass::ion);
}

TEST(Martini, RadiiAreThoseOfTheVersionThatTheNamesTell) {
  // sigma * 2^(1/6) / 2: 2.638 Å of 4.7, 2.413 of 4.3, 2.301 of 4.1, 1.908 of 3.4.
  std::map<std::string, double> three = radii_of(read(with(kLipid, {{2, "ALA", "BB"}, {2, "ALA", "SC1"}})));
  EXPECT_EQ(three["BB"], 2.301);
  EXPECT_EQ(three["SC1"], 1.908);
  EXPECT_EQ(three["GL1"], 2.301);
  EXPECT_EQ(three["GL2"], 2.638);
  const std::vector<Row> ring{{3, "PHE", "BB"}, {3, "PHE", "SC1"}, {3, "PHE", "SC2"}, {3, "PHE", "SC3"}};
  std::map<std::string, double> two = radii_of(read(with(with(kLipid, {{2, "ALA", "BB"}}), ring)));
  EXPECT_EQ(two["BB"], 2.638);
  EXPECT_EQ(two["SC1"], 2.413);
  EXPECT_EQ(two["GL1"], 2.638);
  EXPECT_EQ(martini_version(read(with(kLipid, {{2, "ALA", "BB"}})).atoms).number, 2);
}

TEST(Martini, WhatTellsNoVersionIsOfTheThirdAndIsSaid) {
  const Structure lipids = read(kLipid);
  EXPECT_EQ(radii_of(lipids)["GL1"], 2.301);
  ASSERT_FALSE(lipids.report.warnings.empty());
  EXPECT_NE(lipids.report.warnings.back().text.find("whether this is Martini 2 or 3"), std::string::npos);
  const Structure chosen = read(kLipid, "martini2");
  EXPECT_EQ(radii_of(chosen)["GL1"], 2.638);
  for (const Warning& warning : chosen.report.warnings)
    EXPECT_EQ(warning.text.find("whether this is Martini"), std::string::npos) << warning.text;
}

TEST(Martini, RadiiOfAtomsAndUnknownBeadsAreRefused) {
  const auto message = [](const std::vector<Row>& rows, const std::string& radii) -> std::string {
    try {
      read(rows, radii);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(kLipid, "bondi").find("holds beads of Martini, for which bondi has no radii"), std::string::npos);
  EXPECT_NE(message(with(kLipid, {{2, "DRUG", "X7"}}), "").find("the type of 1 bead is unknown: 'X7'"),
            std::string::npos)
      << message(with(kLipid, {{2, "DRUG", "X7"}}), "");
}

TEST(Martini, AtomsBesideBeadsAreCounted) {
  const Structure mixed =
      read(with(kLipid, {{2, "GLY", "N"}, {2, "GLY", "CA"}, {2, "GLY", "C"}, {2, "GLY", "O"}}), "martini2");
  const auto said = std::ranges::find_if(mixed.report.warnings, [](const Warning& warning) {
    return warning.text.find("martini2 gives no radius to 4 atoms; Bondi's of the element is used") !=
           std::string::npos;
  });
  EXPECT_NE(said, mixed.report.warnings.end());
}

TEST(Martini, BondsFollowTheTopologyOfALipid) {
  const Structure structure = read(kLipid);
  std::vector<Atom> atoms = structure.atoms;
  for (Atom& atom : atoms) atom.position *= 0.3;  // All atoms are near.
  EXPECT_EQ(molecule_bonds(atoms, {}), (std::vector<Bond>{{0, 1}, {1, 2}, {2, 3}, {2, 4}, {3, 6}, {4, 5}, {6, 7}}));
}

TEST(Martini, AtomsWithSuchNamesStayAtoms) {
  const TemporaryFolder folder;
  std::string heme;
  int serial = 0;
  for (const char* name : {" C1A", " C2A", " C3A", " C1B", " C2B"}) {
    ++serial;
    heme += fmt::format("HETATM{:5} {:4} HEM A   1    {:8.3f}{:8.3f}{:8.3f}  1.00  0.00           C  \n", serial, name,
                        1.4 * serial, 0.0, 0.0);
  }
  const Structure structure = read_structure(folder.file("heme.pdb", heme), {});
  for (const Atom& atom : structure.atoms) EXPECT_EQ(atom.element, 6);
  EXPECT_EQ(martini_version(structure.atoms).number, 0);
}

}  // namespace
}  // namespace meniscus
