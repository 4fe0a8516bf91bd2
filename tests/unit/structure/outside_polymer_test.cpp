// SPDX-License-Identifier: BSD-3-Clause
// Atoms that a surface takes from a file with a polymer, and the other molecules that pictures draw.
#include "core/structure/residues.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/structure/formats/read_structure.h"
#include "tests/support/pdb_line.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

using test::PdbLine;
using test::TemporaryFolder;

/// Makes atoms of residues that are far apart from each other.
class Molecules {
 public:
  void add(AtomClass kind, const std::string& residue, std::size_t atoms = 1, std::int32_t model = 1) {
    ++residues_;
    for (std::size_t n = 0; n < atoms; ++n) {
      Atom& atom = atoms_.emplace_back();
      atom.kind = kind;
      atom.residue_name = residue;
      atom.residue = residues_;
      atom.model = model;
      atom.element = kind == AtomClass::ion ? 30 : 6;
      atom.name = "C" + std::to_string(n);
      atom.index = static_cast<std::uint32_t>(atoms_.size() - 1);
      atom.position = {20.0 * residues_, 1.5 * static_cast<double>(n), 0.0};
    }
  }
  void add_many(std::size_t times, AtomClass kind, const std::string& residue, std::size_t atoms = 1) {
    for (std::size_t n = 0; n < times; ++n) add(kind, residue, atoms);
  }
  OutsidePolymer outside() const { return outside_polymer(atoms_, {}); }
  std::size_t drawn() const { return static_cast<std::size_t>(std::ranges::count(outside().drawn, true)); }
  std::size_t count(OutsidePolymer::Part part) const {
    return static_cast<std::size_t>(std::ranges::count(outside().part, part));
  }

 private:
  std::vector<Atom> atoms_;
  std::uint32_t residues_ = 0;
};

using Part = OutsidePolymer::Part;

TEST(OutsidePolymer, AFileWithoutAPolymerIsTakenWhole) {
  Molecules box;
  box.add_many(30, AtomClass::ligand, "POPC", 20);
  box.add(AtomClass::unclassified, "");
  EXPECT_TRUE(box.outside().part.empty());
  EXPECT_TRUE(box.outside().drawn.empty());
}

TEST(OutsidePolymer, LigandsAndIonsAreDrawnAndWaterIsNot) {
  Molecules crystal;
  crystal.add_many(5, AtomClass::polymer, "ALA", 5);
  crystal.add(AtomClass::ligand, "HEM", 43);
  crystal.add(AtomClass::ion, "ZN");
  crystal.add_many(3, AtomClass::water, "HOH");
  EXPECT_EQ(crystal.count(Part::ligand), 43u);
  EXPECT_EQ(crystal.count(Part::inside), 25u + 1u + 3u);
  EXPECT_EQ(crystal.drawn(), 44u);
}

TEST(OutsidePolymer, MembranesSaltAndSolventAreNotDrawn) {
  Molecules box;
  box.add_many(5, AtomClass::polymer, "ALA", 5);
  box.add_many(15, AtomClass::ligand, "POPC", 45);
  box.add_many(15, AtomClass::ligand, "POPE", 45);  // Together they are more than a few.
  box.add_many(21, AtomClass::ion, "NA");
  box.add_many(21, AtomClass::ligand, "EOH", 3);
  EXPECT_EQ(box.count(Part::lipid), 30u * 45u);
  EXPECT_EQ(box.count(Part::ligand), 63u);
  EXPECT_EQ(box.drawn(), 0u);
  box.add_many(30, AtomClass::ligand, "CLA", 65);
  EXPECT_EQ(box.drawn(), 30u * 65u) << "many large cofactors";
}

TEST(OutsidePolymer, AFewOfEachModelAreDrawn) {
  Molecules ensemble;
  for (std::int32_t model = 1; model <= 30; ++model) {
    ensemble.add(AtomClass::polymer, "ALA", 5, model);
    ensemble.add(AtomClass::ligand, "GOL", 6, model);
    ensemble.add(AtomClass::ligand, "POPC", 45, model);
  }
  EXPECT_EQ(ensemble.drawn(), 30u * 51u);
}

TEST(OutsidePolymer, IonsInABoxOfWaterAreSalt) {
  Molecules box;
  box.add_many(2, AtomClass::polymer, "ALA", 5);
  box.add(AtomClass::ion, "NA");
  box.add_many(20, AtomClass::water, "SOL", 3);
  EXPECT_EQ(box.drawn(), 1u);
  box.add(AtomClass::water, "SOL", 3);
  EXPECT_EQ(box.drawn(), 0u);
}

std::string line(const char* record, const char* name, const char* residue, int number, double x, const char* element) {
  PdbLine atom;
  atom.record = record;
  atom.name = name;
  atom.residue = residue;
  atom.number = number;
  atom.x = fmt::format("{:8.3f}", x);
  atom.element = element;
  return atom.text();
}

/// Returns two residues of a chain, a selenomethionine, two sugars bound to it, a free sugar, a ligand of two atoms,
/// zinc, water.
std::string sample() {
  return line("ATOM", " N  ", "ASN", 1, 0.0, " N") + line("ATOM", " CA ", "ASN", 1, 1.45, " C") +
         line("ATOM", " C  ", "ASN", 1, 2.9, " C") + line("HETATM", " N  ", "MSE", 2, 4.2, " N") +
         line("HETATM", " CA ", "MSE", 2, 5.7, " C") + line("HETATM", " C  ", "MSE", 2, 7.2, " C") + "TER\n" +
         line("HETATM", " C1 ", "NAG", 3, -1.4, " C") + line("HETATM", " O4 ", "NAG", 3, -2.8, " O") +
         line("HETATM", " C1 ", "NAG", 4, -4.2, " C") + line("HETATM", " C1 ", "NAG", 5, 40.0, " C") +
         line("HETATM", " C1 ", "LIG", 6, 50.0, " C") + line("HETATM", " O1 ", "LIG", 6, 51.3, " O") +
         line("HETATM", "ZN  ", " ZN", 7, 60.0, "ZN") + line("HETATM", " O  ", "HOH", 8, 70.0, " O") + "END\n";
}

TEST(PolymerRule, TakesModifiedResiduesAndBoundSugars) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.pdb", sample());
  const Structure structure = read_structure(path);
  EXPECT_EQ(structure.atoms.size(), 9u);
  EXPECT_EQ(structure.companions, Companions::hidden);
  EXPECT_TRUE(structure.extra_atoms.empty());
  EXPECT_EQ(structure.report.sentence(),
            "14 atoms read; 1 water atom, 1 free ion, 3 ligand atoms (LIG, NAG) left out; 9 used (--select all adds "
            "ligands)");
  EXPECT_EQ(structure.report.excluded.at(kExcludedLigand), 3u);
  EXPECT_EQ(structure.report.residues.at(kExcludedLigand).at("LIG"), 1u);
}

TEST(PolymerRule, ASelectionTakesItsPlace) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.pdb", sample());
  ReadOptions options;
  options.selection = parse_selection("all");
  options.companions = Companions::drawn;
  const Structure all = read_structure(path, options);
  EXPECT_EQ(all.atoms.size(), 12u);
  EXPECT_EQ(all.companions, Companions::none);
  EXPECT_TRUE(all.extra_atoms.empty());
  options.selection.reset();
  options.keep_water = options.keep_ions = true;
  EXPECT_EQ(read_structure(path, options).atoms.size(), 11u) << "water and ions are added to the polymer";
  options.takes_ligands = true;
  EXPECT_EQ(read_structure(path, options).atoms.size(), 14u);
}

/// Returns the number of atoms with each bit of Atom::shown: sticks, spheres, hidden.
std::array<std::ptrdiff_t, 3> marked(const Structure& structure) {
  const auto count = [&](std::size_t bit) {
    return std::ranges::count_if(structure.extra_atoms,
                                 [&](const Atom& atom) { return (atom.shown >> bit & 1u) != 0; });
  };
  return {count(kCompanionSticks), count(kCompanionSpheres), count(kHiddenCompanion)};
}

TEST(PolymerRule, CompanionsAreWhatNothingElseDraws) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.pdb", sample());
  ReadOptions options;
  options.companions = Companions::drawn;
  EXPECT_EQ(marked(read_structure(path, options)), (std::array<std::ptrdiff_t, 3>{3, 1, 0}));
  options.shown = {{"sticks", parse_selection("resname LIG"), true}};
  EXPECT_EQ(marked(read_structure(path, options)), (std::array<std::ptrdiff_t, 3>{1, 1, 0}));
  options.shown = {{"tube", parse_selection("resname LIG"), false}};
  EXPECT_EQ(marked(read_structure(path, options)), (std::array<std::ptrdiff_t, 3>{3, 1, 0}));
  options.keep_ions = true;
  EXPECT_EQ(marked(read_structure(path, options)), (std::array<std::ptrdiff_t, 3>{3, 0, 0}));
  options.shown.clear();
  options.companions = Companions::hidden;
  EXPECT_EQ(marked(read_structure(path, options)), (std::array<std::ptrdiff_t, 3>{0, 0, 3}));
}

TEST(PolymerRule, FramesKeepTheAtomsOfTheFile) {
  const TemporaryFolder folder;
  ReadOptions options;
  options.companions = Companions::drawn;
  const StructureFile file(folder.file("a.pdb", sample()), options);
  std::vector<glm::dvec3> positions(14);
  for (std::size_t n = 0; n < positions.size(); ++n) positions[n] = {10.0 * static_cast<double>(n), 0.0, 0.0};
  const Structure moved = file.at(positions);
  EXPECT_EQ(moved.atoms.size(), 9u) << "sugars that were bound stay";
  EXPECT_EQ(marked(moved), (std::array<std::ptrdiff_t, 3>{3, 1, 0}));
}

}  // namespace
}  // namespace meniscus
