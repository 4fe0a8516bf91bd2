// SPDX-License-Identifier: BSD-3-Clause
// Bad molecule files: each gives exit code 3 (or 5), one line with the file's name and advice, and no output.
#include <sys/stat.h>

#include <filesystem>
#include <algorithm>
#include <cctype>

#include <gtest/gtest.h>

#include "tests/support/run_program.h"
#include "tests/support/pdb_line.h"

namespace meniscus {
namespace {

using test::gzipped;
using test::PdbLine;
using test::TemporaryFolder;

constexpr int kInput = 3;
constexpr int kCapacity = 5;

/// One bad file: its name, content, and a part of the required message.
struct BadFile {
  const char* what;
  const char* name;
  std::string content;
  const char* message;
  int exit_code = kInput;
};

void PrintTo(const BadFile& bad, std::ostream* out) { *out << bad.what; }

std::string pdb(const PdbLine& line) { return line.text(); }
std::string pdb_x(const std::string& x) { return pdb({}) + pdb({.x = x}); }

std::string with(std::string text, std::string_view from, std::string_view to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

const std::string kMmcif =
    "data_x\nloop_\n_atom_site.type_symbol\n_atom_site.label_atom_id\n_atom_site.label_comp_id\n"
    "_atom_site.label_asym_id\n_atom_site.label_seq_id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n"
    "C CA GLY A 1 1.0 2.0 3.0\nC C GLY A 1 4.0 5.0 6.0\n";

const std::string kPqr = "ATOM 1 N ALA A 1 0 0 0 -0.3 1.85\n";
const std::string kGroAtom = "    1ALA     CA    1   0.000   0.000   0.000\n";
std::string gro(const std::string& count, const std::string& atoms) {
  return "title\n" + count + "\n" + atoms + " 1.0 1.0 1.0\n";
}

std::vector<BadFile> bad_files() {
  const std::string water = pdb({.record = "HETATM", .name = " O  ", .residue = "HOH", .element = " O"});
  const std::string good_gz = gzipped(pdb({}));
  std::string wrong_crc = good_gz;
  wrong_crc[wrong_crc.size() - 6] ^= 0x55;
  const std::string huge_line(std::size_t{10} << 20, 'x');
  return {
      // Files in general (catalogue 2-6)
      {"empty file", "a.pdb", "", "is empty"},
      {"blank file", "a.pdb", "\n \t\n\n", "is empty"},
      {"empty gzip", "a.pdb.gz", gzipped(""), "is empty"},
      {"utf-16", "a.pdb",
       std::string("\xff\xfe"
                   "A\0T\0",
                   6),
       "UTF-16"},
      {"nul bytes", "a.pdb", pdb({}) + std::string("\0\0", 2), "binary"},
      {"binary garbage", "a.pdb",
       std::string("\x7f"
                   "ELF\x02\x01\x01\0\0\xb7",
                   10),
       "binary"},
      {"high bytes without nul", "a.pdb", "\xb1\xfe\x9a\x80\xc3\x28", "no ATOM or HETATM"},
      {"10 MB line", "a.pdb", huge_line, "the line has 10,485,760 bytes", kCapacity},
      {"gzip cut short", "a.pdb.gz", good_gz.substr(0, good_gz.size() / 2), "cut short"},
      {"gzip cut in its trailer", "a.pdb.gz", good_gz.substr(0, good_gz.size() - 3), "cut short"},
      {"gzip with wrong crc", "a.pdb.gz", wrong_crc, "damaged"},
      {"gzip with trailing garbage", "a.pdb.gz", good_gz + "garbage", "other bytes after its gzip data"},
      {"gzip header only", "a.pdb.gz", std::string("\x1f\x8b", 2), "cut short"},
      {"bzip2", "a.pdb.bz2", "BZh91AY&SY", "is packed with bzip2; only gzip is read, unpack it first: bzip2 -dk"},
      {"zstd", "a.pdb.zst", "\x28\xb5\x2f\xfd", "zstd -d"},
      {"compress", "a.pdb.Z", "\x1f\x9d\x90", "gzip -dk"},
      {"lz4", "a.pdb.lz4", "\x04\x22\x4d\x18", "lz4 -dk"},
      {"gzipped tar", "a.pdb.gz", gzipped(std::string(257, 'a') + "ustar\0"), "is packed with tar"},
      {"columns shifted by residue 10000", "a.pdb", pdb({.number = 10000}),
       "begin in column 32 instead of 31, as after a number that is too long for its columns"},
      {"tinker", "a.xyz", "2\n 1 O 0.0 0.0 0.0 21 2\n 2 H 1.0 0.0 0.0 22 1\n", "is XYZ of Tinker"},
      {"tinker with a title", "a.xyz", "1 water\n 1 O 0.0 0.0 0.0 21\n", "obabel -itxyz"},
      {"old prmtop", "a.prmtop", "\n    65    16    31    33    69    46   104    77     0     0   339    10\n",
       "prmtop files of Amber 6"},
      {"gro of an odd box", "a.gro", "title\n1\n" + kGroAtom + "1.0 1.0\n", "where the box"},
      {"xz", "a.pdb.xz",
       "\xfd"
       "7zXZ",
       "xz -dk"},
      {"zip", "a.zip", "PK\x03\x04", "zip"},
      {"html as pdb", "a.pdb", "<!DOCTYPE html>\n<html><body>404</body></html>\n", "looks like HTML"},
      {"json", "a.pdb", "{\"data_1abc\": {}}", "looks like JSON"},
      {"prose", "a.txt", "This is not a molecule.\n", "none of the formats that are read"},
      {"prose named pdb", "a.pdb", "This is not a molecule.\n", "no ATOM or HETATM"},
      {"pdb named cif", "a.cif", pdb({}), "the name says mmCIF, but the content is PDB"},
      {"mmcif named pdb", "a.pdb", kMmcif, "the name says PDB, but the content is mmCIF"},
      {"gzipped xyzr named pdb", "a.pdb.gz", gzipped("0 0 0 1.7\n"), "the name says PDB, but the content is XYZR"},
      // PQR (33)
      {"pdb named pqr", "a.pqr", pdb({}), "the name says PQR, but the content is PDB"},
      {"pqr named pdb", "a.pdb", kPqr, "the name says PDB, but the content is PQR"},
      {"pqr without radius", "a.pqr", "ATOM 1 N ALA 1 0 0 0 0.1\n",
       ":1: 'ATOM 1 N ALA 1 0 0 0 0.1' cannot be split into fields"},
      {"pqr of touching numbers", "a.pqr", kPqr + "ATOM 2 C ALA A 1 -100.125-100.25 0 0.1 1.5\n", ":2: 'ATOM 2 C ALA"},
      {"pqr negative radius", "a.pqr", kPqr + "ATOM 2 C ALA A 1 1 0 0 0.1 -1.0\n", ":2: radius is -1 Å"},
      {"pqr nan radius", "a.pqr", kPqr + "ATOM 2 C ALA A 1 1 0 0 0.1 nan\n",
       ":2: radius is 'nan', not a finite number"},
      {"pqr huge radius", "a.pqr", kPqr + "ATOM 2 C ALA A 1 1 0 0 0.1 1e6\n", ":2: radius is 1000000 Å, above"},
      {"pqr nan charge", "a.pqr", kPqr + "ATOM 2 C ALA A 1 1 0 0 nan 1.5\n", ":2: charge is 'nan', not a finite"},
      {"pqr nan coordinate", "a.pqr", kPqr + "ATOM 2 C ALA A 1 1 nan 0 0.1 1.5\n", ":2: coordinate y is 'nan'"},
      {"pqr number", "a.pqr", kPqr + "ATOM 2 C ALA A x1 1 0 0 0.1 1.5\n", ":2: 'ATOM 2 C ALA A x1"},
      // GRO (30, 31)
      {"gro count text", "a.gro", gro("many", kGroAtom), ":2: 'many' should be the number of atoms"},
      {"gro count negative", "a.gro", gro("-1", kGroAtom), ":2: '-1' should be the number of atoms"},
      {"gro count 2 to the 31", "a.gro", gro("2147483648", kGroAtom),
       ":2: the count says 2,147,483,648 atoms, more than"},
      {"gro count of twenty digits", "a.gro", gro("99999999999999999999", kGroAtom), ":2: '99999999999999999999'"},
      {"gro count too large", "a.gro", gro("2", kGroAtom), ":4: ' 1.0 1.0 1.0' does not have three coordinates"},
      {"gro count too small", "a.gro", gro("1", kGroAtom + kGroAtom),
       ":4: '    1ALA     CA    1   0.000   0.000   0...' was found where the box"},
      {"gro without box", "a.gro", "title\n1\n" + kGroAtom, ":3: is the last line; the box"},
      {"gro without count", "a.gro", "title\n", ":1: is the last line; a title and the number"},
      {"gro without atoms", "a.gro", gro("0", ""), "holds no atoms"},
      {"gro stars", "a.gro", gro("1", with(kGroAtom, "   0.000", "********")), ":3: coordinate x is '********'"},
      {"gro far", "a.gro", gro("1", with(kGroAtom, "   0.000", "20000.00")), ":3: coordinate x is 200000 Å, beyond"},
      {"gro residue number", "a.gro", gro("2", kGroAtom + with(kGroAtom, "    1", "    x")),
       ":4: residue number '    x' in columns 1 to 5 is not a number"},
      // XYZ (32)
      {"xyz count text", "a.xyz", "C 0 0 0\n", ":1: 'C 0 0 0' should be the number of atoms of the file"},
      {"xyz count negative", "a.xyz", "-2\n\nC 0 0 0\n", ":1: '-2' should be the number of atoms"},
      {"xyz count huge", "a.xyz", "4294967296\n\nC 0 0 0\n", ":1: the count says 4,294,967,296 atoms, more than"},
      {"xyz count too small", "a.xyz", "1\n\nC 0 0 0\nC 2 2 2\n",
       ":4: 'C 2 2 2' should be the number of atoms of a further"},
      {"xyz count too large", "a.xyz", "3\n\nC 0.00 0.00 0.00\nC 2.00 2.00 2.00\n",
       ":1: the count says 3 atoms, but the file ends after 2"},
      {"xyz of three columns", "a.xyz", "2\n\nC 0 0 0\nC 1 1\n", ":4: 'C 1 1' has 3 columns where an atom needs 4"},
      {"xyz nan", "a.xyz", "2\n\nC 0 0 0\nC 1 nan 1\n", ":4: coordinate y is 'nan'"},
      {"xyz far", "a.xyz", "2\n\nC 0 0 0\nC 1 2D7 1\n", ":4: coordinate y is 20000000 Å, beyond"},
      {"xyz symbol", "a.xyz", "2\n\nC 0 0 0\nQq 1 1 1\n", "element of 1 atom is unknown: 'Qq' (atom 2)"},
      {"xyz of no atoms", "a.xyz", "0\n\n", "holds no atoms"},
      {"xyzr named xyz", "a.xyz", "6 0 0 0\n", "the name says XYZ, but the content is XYZR"},
      // PDB (10-14, 19)
      {"header only", "a.pdb", "HEADER    X\nEND\n", "no ATOM or HETATM"},
      {"only water", "a.pdb", water, "no atoms are left"},
      {"atom cut at x", "a.pdb", pdb({}) + pdb({}).substr(0, 36) + "\n", ":2: atom record"},
      {"atom cut at z", "a.pdb", pdb({}).substr(0, 50), ":1: atom record"},
      {"nan", "a.pdb", pdb_x("     nan"), ":2: coordinate x is '     nan'"},
      {"inf", "a.pdb", pdb_x("    -inf"), ":2: coordinate x"},
      {"stars", "a.pdb", pdb_x("********"), ":2: coordinate x is '********'"},
      {"overflow", "a.pdb", pdb_x("   1e400"), ":2: coordinate x"},
      {"blank", "a.pdb", pdb_x("        "), ":2: coordinate x"},
      {"two points", "a.pdb", pdb_x("   1.2.3"), ":2: coordinate x"},
      {"comma", "a.pdb", pdb_x("   1,200"), ":2: coordinate x"},
      {"letters", "a.pdb", pdb_x("   12x.0"), ":2: coordinate x"},
      {"y", "a.pdb", pdb({.y = "     nan"}), ":1: coordinate y"},
      {"z", "a.pdb", pdb({.z = "     nan"}), ":1: coordinate z"},
      {"shifted columns", "a.pdb", pdb_x("-1000.12") + pdb({.x = "3-1000.4"}), ":3: coordinate x"},
      {"far away", "a.pdb", pdb_x("10000000"), "beyond the extent"},
      {"unknown element", "a.pdb", pdb({}) + pdb({.name = " X1 ", .residue = "UNL", .number = 2, .element = " X"}),
       "element of 1 atom is unknown: 'X1' in UNL A2"},
      {"terminal escapes", "a.pdb", pdb({.x = "\x1b[2J\x1b[1;"}), "\\x1b[2J"},
      // XYZR
      {"xyzr of three columns", "a.xyzr", "0 0 0 1.7\n1 2 3\n", ":2: '1 2 3' has fewer than four columns"},
      {"xyzr nan", "a.xyzr", "0 0 0 1.7\n1 nan 3 1.7\n", ":2: coordinate y is 'nan'"},
      {"xyzr text first", "a.xyzr", "x y z r\n0 0 0 1.7\n", ":1: coordinate x is 'x'"},
      {"xyzr negative radius", "a.xyzr", "0 0 0 -1.0\n", ":1: radius is -1 Å"},
      {"xyzr nan radius", "a.xyzr", "0 0 0 nan\n", ":1: radius is 'nan'"},
      {"xyzr inf radius", "a.xyzr", "0 0 0 inf\n", ":1: radius is 'inf'"},
      {"xyzr huge radius", "a.xyzr", "0 0 0 1e6\n", ":1: radius is 1000000 Å, above"},
      {"xyzr far", "a.xyzr", "0 0 0 1.7\n1e7 0 0 1.7\n", ":2: coordinate x is 10000000 Å, beyond"},
      {"xyzr of zero radii", "a.xyzr", "0 0 0 0\n", "no atoms are left"},
      {"xyzr of comments", "a.xyzr", "# nothing\n", "no atoms are left"},
      // mmCIF (26-28)
      {"no data block", "a.cif", "loop_\n_atom_site.id\n1\n", "not a readable mmCIF"},
      {"no atoms", "a.cif", "data_x\n_entry.id x\n", "no table _atom_site"},
      {"wrong column count", "a.cif", kMmcif + "C\n", "not a readable mmCIF"},
      {"unclosed quote", "a.cif", with(kMmcif, "C CA", "C 'CA"), "not a readable mmCIF"},
      {"unclosed text", "a.cif", with(kMmcif, "C CA", "C\n;CA"), "not a readable mmCIF"},
      {"duplicated tag", "a.cif", with(kMmcif, "label_comp_id", "label_atom_id"), "not a readable mmCIF"},
      {"question mark", "a.cif", with(kMmcif, " 4.0", " ?"), ":12: coordinate x is '?'"},
      {"cif nan", "a.cif", with(kMmcif, "6.0", "nan"), ":12: coordinate z is 'nan'"},
      {"fractional", "a.cif", "data_x\nloop_\n_atom_site_label\n_atom_site_fract_x\nC1 0.5\n",
       "fractional coordinates"},
      {"cif cut short", "a.cif", kMmcif.substr(0, kMmcif.size() - 8), "not a readable mmCIF"},
  };
}

class BadInput : public testing::TestWithParam<BadFile> {};

TEST_P(BadInput, IsOneLineAndTheExitCode) {
  const BadFile& bad = GetParam();
  const TemporaryFolder folder;
  const std::string path = folder.file(bad.name, bad.content);
  const test::ProgramResult result = test::run_program(test::meniscus_program(), {"surface", path, "--json"});
  EXPECT_EQ(result.exit_code, bad.exit_code) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(result.err.starts_with("meniscus: error: " + path)) << result.err;
  EXPECT_NE(result.err.find(bad.message), std::string::npos) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(result.err.find('\x1b'), std::string::npos);
  EXPECT_EQ(folder.entries().size(), 1u);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, BadInput, testing::ValuesIn(bad_files()), [](const auto& bad) {
  std::string name = bad.param.what;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

void expect_refused(const std::string& path, const char* message) {
  const test::ProgramResult result = test::run_program(test::meniscus_program(), {"surface", path}, 20);
  EXPECT_EQ(result.exit_code, kInput) << path << result.err;
  EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
}

TEST(BadPath, FilesThatAreNoFiles) {
  const TemporaryFolder folder;
  expect_refused((folder.path() / "missing.pdb").string(), "No such file");
  expect_refused(folder.path().string(), "is a folder");
  expect_refused("/dev/zero", "pipe or device");
  const std::string fifo = folder.path() / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  expect_refused(fifo, "pipe or device");
  std::filesystem::create_symlink("loop", folder.path() / "loop");
  expect_refused((folder.path() / "loop").string(), "symbolic links");
  expect_refused(std::string(5000, 'x'), "name too long");
  expect_refused("", "No such file");
}

TEST(BadPath, OddNamesWork) {
  const TemporaryFolder folder;
  for (const char* name : {"with space.pdb", "quo'te\".pdb", "new\nline.pdb", "%04d.pdb", "-dash.pdb", "ümlaut.pdb"}) {
    const std::string path = folder.file(name, PdbLine{}.text());
    const test::ProgramResult result = test::run_program(test::meniscus_program(), {"surface", path});
    EXPECT_EQ(result.exit_code, 0) << name << result.err;
  }
}

}  // namespace
}  // namespace meniscus
