// SPDX-License-Identifier: BSD-3-Clause
// BinaryCIF: every encoding, the path from a file to a structure, and files that are damaged or lie.
#include "core/structure/formats/read_structure.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/binary_cif.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

using namespace test;

std::string three_atoms() { return binary_cif({category("_atom_site", 3, atom_columns())}); }

Structure read_bytes(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  ReadOptions options;
  options.list_assemblies = true;
  return read_structure(folder.file(name, bytes), options);
}

TEST(BinaryCif, EveryEncodingIsDecoded) {
  const Structure structure = read_bytes("a.bcif", three_atoms());
  EXPECT_EQ(structure.format, "BinaryCIF");
  ASSERT_EQ(structure.atoms.size(), 3u);
  const glm::dvec3 places[] = {{1.5, 0, 0.5}, {-2.25, 1, 1.5}, {300, 2, 2.5}};
  for (std::size_t n = 0; n < 3; ++n) EXPECT_EQ(structure.atoms[n].position, places[n]) << n;
  EXPECT_EQ(structure.atoms[1].name, "CA");
  EXPECT_EQ(structure.atoms[1].element, 6);
  EXPECT_EQ(structure.atoms[2].name, "O5'");
  EXPECT_EQ(structure.atoms[0].residue_name, "ALA");
  EXPECT_EQ(structure.atoms[0].chain, "A");
  EXPECT_EQ(structure.atoms[0].residue_number, 300);  // 255 and 45, twice
  EXPECT_EQ(structure.atoms[1].residue_number, 300);
  EXPECT_EQ(structure.atoms[2].residue_number, 7);
  EXPECT_EQ(structure.atoms[1].b_factor, 20.25F);
  EXPECT_TRUE(std::isnan(structure.atoms[2].b_factor));
}

TEST(BinaryCif, NameAndPackingDoNotMatter) {
  EXPECT_EQ(read_bytes("a", three_atoms()).format, "BinaryCIF");
  EXPECT_EQ(read_bytes("a.bcif.gz", gzipped(three_atoms())).atoms.size(), 3u);
  EXPECT_THROW(read_bytes("a.pdb", three_atoms()), InputError);
}

TEST(BinaryCif, ExperimentAndConfidenceAreThoseOfMmcif) {
  const std::vector<std::int8_t> one{0}, all{0, 0, 0};
  std::vector<Json> columns;
  for (const Json& known : atom_columns())
    if (known.at("name") != "label_asym_id" && known.at("name") != "label_seq_id") columns.push_back(known);
  columns.push_back(column("label_asym_id", strings("A", {0, 1}, all)));
  columns.push_back(column("label_seq_id", strings("7", {0, 1}, all)));
  const Structure structure = read_bytes(
      "a.bcif",
      binary_cif({category("_atom_site", 3, columns),
                  category("_exptl", 1, {column("method", strings("SOLUTION NMR", {0, 12}, one))}),
                  category("_ma_qa_metric", 1,
                           {column("id", strings("1", {0, 1}, one)), column("type", strings("pLDDT", {0, 5}, one)),
                            column("mode", strings("local", {0, 5}, one))}),
                  category("_ma_qa_metric_local", 1,
                           {column("metric_id", strings("1", {0, 1}, one)),
                            column("metric_value", strings("87.5", {0, 4}, one)),
                            column("label_asym_id", strings("A", {0, 1}, one)),
                            column("label_seq_id", strings("7", {0, 1}, one))})}));
  EXPECT_EQ(structure.experiment, "SOLUTION NMR");
  EXPECT_EQ(structure.atoms.at(0).confidence, 87.5f);
}

TEST(BinaryCif, EntitiesAndAssembliesAreThoseOfMmcif) {
  const std::vector<std::int8_t> one{0};
  std::vector<Json> columns = atom_columns();
  columns.push_back(column("label_entity_id", strings("1", {0, 1}, {0, 0, 0})));
  std::vector<Json> operators{column("id", strings("1", {0, 1}, one))};
  for (const char* name : {"matrix[1][1]", "matrix[2][2]", "matrix[3][3]"})
    operators.push_back(column(name, data<std::int8_t>({1}, 1)));
  for (const char* name : {"matrix[1][2]", "matrix[1][3]", "matrix[2][1]", "matrix[2][3]", "matrix[3][1]",
                           "matrix[3][2]", "vector[1]", "vector[2]", "vector[3]"})
    operators.push_back(column(name, data<double>({0.0}, 33)));
  const Structure structure = read_bytes(
      "a.bcif", binary_cif({category("_unknown", 1, {column("x", data<double>({0.0}, 99))}),  // unused by our reader
                            category("_atom_site", 3, columns),
                            category("_entity", 1,
                                     {column("id", strings("1", {0, 1}, one)),
                                      column("type", strings("non-polymer", {0, 11}, one))}),
                            category("_pdbx_struct_oper_list", 1, operators),
                            category("_pdbx_struct_assembly_gen", 1,
                                     {column("assembly_id", strings("1", {0, 1}, one)),
                                      column("oper_expression", strings("1", {0, 1}, one)),
                                      column("asym_id_list", strings("A,B", {0, 3}, one))})}));
  EXPECT_EQ(structure.atoms.at(0).kind, AtomClass::ligand);
  ASSERT_EQ(structure.assemblies.size(), 1u);
  EXPECT_EQ(structure.assemblies[0].parts.at(0).chains, (std::vector<std::string>{"A", "B"}));
}

void expect_refused(const std::string& bytes, const std::string& message) {
  try {
    read_bytes("a.bcif", bytes);
    ADD_FAILURE() << "no error: " << message;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

/// Returns the three atoms with another column in place of the x.
std::string with_x(const Json& values, const Json& mask = nullptr) {
  std::vector<Json> columns = atom_columns();
  columns[0] = column("Cartn_x", values, mask);
  return binary_cif({category("_atom_site", 3, columns)});
}

TEST(BinaryCif, DamagedFilesAreRefusedInOneLine) {
  const std::string whole = three_atoms();
  expect_refused(whole.substr(0, whole.size() / 2), "is not a readable BinaryCIF file: ");
  expect_refused(whole.substr(0, whole.size() / 2), "is it cut short?");
  expect_refused(
      "\x83\xa7"
      "encoder" +
          std::string(1'000'000, '\x91'),
      "nested too deep");
  expect_refused("prose", "is not BinaryCIF");
  expect_refused(binary_cif({}), "has no table _atom_site");
  expect_refused(with_x(data<double>({1, 2}, 33)), "column _atom_site.Cartn_x has 2 values in 3 rows");
  expect_refused(with_x(data<double>({1, 2, 3}, 33), data<std::uint8_t>({0}, 4)), "has a mask for 1 of 3 rows");
  expect_refused(with_x(data<double>({1, 2, NAN}, 33)), "coordinate x is 'nan'");
  expect_refused(with_x(data<double>({1, 2, 3}, 33), data<std::uint8_t>({0, 1, 0}, 4)), "coordinate x is '.'");
  expect_refused(with_x(data<std::int8_t>({1, 2, 3}, 7)), "has numbers of type 7");
  expect_refused(with_x(data<std::int8_t>({1, 2, 3}, 3)), "has 3 bytes for numbers of 4");
  expect_refused(with_x(data<std::int8_t>({1, 2, 3}, 1, {{{"kind", "Huffman"}}})), "is encoded by 'Huffman'");
  expect_refused(with_x(data<double>({1, 2, 3}, 33, {{{"kind", "Delta"}, {"origin", 0}}})),
                 "has Delta of numbers that are not whole");
  expect_refused(with_x({{"data", bytes_of<double>({1, 2, 3})}, {"encoding", Json::array()}}), "has no encoding");
  expect_refused(with_x({{"data", 7}, {"encoding", Json::array({byte_array(1)})}}), "is not a readable BinaryCIF");
  expect_refused(with_x(strings("abc", {0, 1}, {0, 0, 1})), "names text 1 of 1");
  expect_refused(with_x(strings("abc", {0, 9}, {0, 0, 0})), "has a text from letter 0 to 9 of 3");
}

TEST(BinaryCif, FilesThatUnpackToMuchAreRefused) {
  const Json repeats = {{"kind", "RunLength"}, {"srcType", 3}, {"srcSize", 3}};
  expect_refused(with_x(data<std::int32_t>({1, 2'000'000'000}, 3, {repeats})), "repeats a value 2000000000 times");
  expect_refused(with_x(data<std::int32_t>({1, -1}, 3, {repeats})), "repeats a value -1 times");
  expect_refused(binary_cif({category("_atom_site", 2'000'000'000, atom_columns())}), "has 2,000,000,000 rows");
  // There are as many rows as the file has bytes, each with a thousand letters.
  std::vector<Json> columns;
  const std::string padding(3'000, 'x');
  const Json places = {{"data", bytes_of<std::int32_t>({0, 4'000})},
                       {"encoding",
                        {{{"kind", "StringArray"},
                          {"dataEncoding", {repeats, byte_array(3)}},
                          {"stringData", padding},
                          {"offsetEncoding", Json::array({byte_array(3)})},
                          {"offsets", bytes_of<std::int32_t>({0, 3'000})}}}}};
  expect_refused(binary_cif({category("_atom_site", 4'000, {column("a", places)}),
                             category("_other", 1, {column("b", strings(padding, {0, 3'000}, {0}))})}),
                 "unpacks to far more letters");
}

}  // namespace
}  // namespace meniscus
