// SPDX-License-Identifier: BSD-3-Clause
// Coordinate files of CHARMM: both widths, residues and segments, and errors.
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/structure/formats/read_structure.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

struct Row {
  int serial, running;
  std::string residue, name;
  double x, y, z;
  std::string segment, number;
};
const std::vector<Row> kRows{{1, 1, "ALA", "N", -999.5, 2.25, 3, "PROA", "5"},
                             {2, 1, "ALA", "CA", -998.25, 2.25, 3.5, "PROA", "5"},
                             {3, 2, "TIP3", "OH2", 7, 8, -9.12345, "WAT", "12B"}};

std::string crd(bool extended, const std::vector<Row>& rows = kRows, const std::string& count = "3") {
  std::string text = "* A TITLE\n*  DATE: TODAY\n*\n" + fmt::format("{:>5}{}\n", count, extended ? "  EXT" : "");
  for (const Row& r : rows)
    text += extended ? fmt::format("{:10}{:10}  {:<8}  {:<8}{:20.10f}{:20.10f}{:20.10f}  {:<8}  {:<8}{:20.10f}\n",
                                   r.serial, r.running, r.residue, r.name, r.x, r.y, r.z, r.segment, r.number, 0.0)
                     : fmt::format("{:5}{:5} {:<4} {:<4}{:10.5f}{:10.5f}{:10.5f} {:<4} {:<4}{:10.5f}\n", r.serial,
                                   r.running, r.residue, r.name, r.x, r.y, r.z, r.segment, r.number, 0.0);
  return text;
}

Structure read_crd(const std::string& text, const char* name = "a.crd") {
  const test::TemporaryFolder folder;
  ReadOptions options;
  options.keep_water = true;
  return read_structure(folder.file(name, text), options);
}

std::string said_of_crd(const std::string& text) {
  try {
    read_crd(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(CharmmCrd, BothWidths) {
  for (const bool extended : {false, true}) {
    const Structure structure = read_crd(crd(extended), extended ? "a" : "a.crd");
    EXPECT_EQ(structure.format, "CRD");
    ASSERT_EQ(structure.atoms.size(), 3u);
    EXPECT_EQ(structure.atoms[0].position, glm::dvec3(-999.5, 2.25, 3));
    EXPECT_EQ(structure.atoms[1].name, "CA");
    EXPECT_EQ(structure.atoms[1].element, 6);
    EXPECT_EQ(structure.atoms[1].residue_number, 5);
    EXPECT_EQ(structure.atoms[1].chain, "PROA");
    EXPECT_EQ(structure.atoms[2].position.z, -9.12345);
    EXPECT_EQ(structure.atoms[2].residue_number, 12);
    EXPECT_EQ(structure.atoms[2].insertion_code, 'B');
    EXPECT_EQ(structure.atoms[2].kind, AtomClass::water);
  }
}

TEST(CharmmCrd, AResidueWithoutANumberHasItsRunningOne) {
  std::vector<Row> rows = kRows;
  rows[2].number = "LIG";
  EXPECT_EQ(read_crd(crd(false, rows)).atoms[2].residue_number, 2);
}

TEST(CharmmCrd, WhatIsWrongIsSaidWithItsLine) {
  std::vector<Row> rows = kRows;
  rows[1].x = rows[1].y = rows[1].z = 9999;
  EXPECT_NE(
      said_of_crd(crd(false, rows)).find("a.crd:6: 'CA' is at 9999 9999 9999, as CHARMM writes atoms that it has not"),
      std::string::npos);
  EXPECT_NE(said_of_crd(crd(true, rows)).find("a.crd:6: 'CA' is at 9999"), std::string::npos);
  EXPECT_NE(said_of_crd(crd(false, kRows, "4")).find("a.crd:4: the count says 4 atoms"), std::string::npos);
  EXPECT_NE(said_of_crd(crd(false, kRows, "2")).find("a.crd:7: comes after the 2 atoms of the count"),
            std::string::npos);
  EXPECT_EQ(read_crd(crd(false) + "\n\n").atoms.size(), 3u);
  EXPECT_NE(said_of_crd(crd(false, kRows, "many")).find("should be the number of atoms"), std::string::npos);
  const std::string text = crd(false);
  EXPECT_NE(said_of_crd(text.substr(0, text.rfind("  -9.12345") + 9))
                .find("ends before its coordinates do; does the count say"),
            std::string::npos);
}

}  // namespace
}  // namespace meniscus
