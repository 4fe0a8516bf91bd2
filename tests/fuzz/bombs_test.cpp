// SPDX-License-Identifier: BSD-3-Clause
// Short inputs that claim large contents are refused before they take much memory, time or stack.
#include <sys/resource.h>

#include <ctime>
#include <fstream>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/text_file.h"
#include "core/camera/camera.h"
#include "core/camera/camera_json.h"
#include "core/structure/assembly.h"
#include "core/structure/formats/structure_formats.h"
#include "core/structure/radii/assign_radii.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "core/trajectory/frame_list.h"
#include "core/trajectory/trajectory.h"
#include "tests/fuzz/target.h"
#include "tests/support/sanitized.h"
#include "tests/trajectory/byte_writer.h"

namespace meniscus::fuzz {
namespace {

/// Bounds address space to 512 MB more than the process has, and time to ten seconds of a core, for the life of this
/// object. With sanitizers the time is ten times as long, and memory has no bound.
class Bounds {
 public:
  Bounds() {
    getrlimit(RLIMIT_AS, &before_);
    if (test::kSanitized) return;
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit bounded = before_;
    bounded.rlim_cur = pages * 4096 + (std::size_t{512} << 20);
    setrlimit(RLIMIT_AS, &bounded);
  }
  ~Bounds() {
    setrlimit(RLIMIT_AS, &before_);
    EXPECT_LT(std::clock() - begin_, (test::kSanitized ? 100 : 10) * CLOCKS_PER_SEC);
  }
  Bounds(const Bounds&) = delete;
  Bounds& operator=(const Bounds&) = delete;

 private:
  rlimit before_{};
  std::clock_t begin_ = std::clock();
};

std::string repeated(const std::string& text, std::size_t times) {
  std::string result;
  for (; times > 0; --times) result += text;
  return result;
}

TEST(Bombs, JsonOfBracketsAlone) {
  const std::string deep = repeated("[", 1'000'000);
  EXPECT_TRUE(is_nested_too_deep(deep));
  EXPECT_FALSE(is_nested_too_deep(repeated("[]", 1'000) + "\"[[" + repeated("[\\\"", 1'000) + "\"{}"));
  EXPECT_FALSE(is_nested_too_deep(repeated("[", kDeepestJson)));
  EXPECT_THROW(parse_camera("{\"position\":" + deep + repeated("]", 1'000'000) + "}", "camera.json"), InputError);
  EXPECT_THROW(
      parse_camera_path("{\"keys\":[{\"frame\":0,\"camera\":" + deep + repeated("]", 1'000'000) + "}]}", "path"),
      InputError);
}

// Every target that reads JSON gets brackets around the place of a value.
TEST(Bombs, JsonInEveryTarget) {
  const std::string deep = repeated("[", 300'000) + repeated("]", 300'000);
  for (const Target& target : targets()) {
    SCOPED_TRACE(target.name);
    EXPECT_NO_THROW(target.run("{\"command\":" + deep + "}"));
    EXPECT_NO_THROW(target.run("{\"schema_version\":" + deep + ",\"schema\":\"meniscus-farm-bundle\"}"));
  }
}

TEST(Bombs, OperatorsOfAssemblies) {
  const Bounds bounds;
  EXPECT_THROW(operator_factors(repeated("(1)", 300'000), "a.cif"), InputError);
  EXPECT_THROW(operator_factors(repeated("1-99999,", 10'000) + "1", "a.cif"), InputError);
  EXPECT_EQ(operator_factors("(1-99999)", "a.cif").at(0).size(), 99'999u);
}

// The name belongs to every product, and is written only once.
TEST(Bombs, AnOperatorOfALongName) {
  const Bounds bounds;
  const std::string cif =
      "data_x\nloop_\n_pdbx_struct_assembly_gen.assembly_id\n_pdbx_struct_assembly_gen.oper_expression\n"
      "_pdbx_struct_assembly_gen.asym_id_list\n1 (" +
      repeated("x", 1'000'000) + ")(1-300)(1-300) A\n";
  EXPECT_THROW(read_mmcif_assemblies({"a.cif", cif}), InputError);
}

TEST(Bombs, AssembliesOfManyOperators) {
  const Bounds bounds;
  std::string cif = "data_x\nloop_\n_pdbx_struct_oper_list.id\n";
  for (const char row : {'1', '2', '3'}) {
    for (const char column : {'1', '2', '3'}) {
      cif += std::string("_pdbx_struct_oper_list.matrix[") + row + "][" + column + "]\n";
    }
    cif += std::string("_pdbx_struct_oper_list.vector[") + row + "]\n";
  }
  for (int n = 1; n <= 300; ++n) cif += std::to_string(n) + " 1 0 0 0 0 1 0 0 0 0 1 0\n";
  cif +=
      "loop_\n_pdbx_struct_assembly_gen.assembly_id\n_pdbx_struct_assembly_gen.oper_expression\n"
      "_pdbx_struct_assembly_gen.asym_id_list\n" +
      repeated("1 (1-300)(1-300) A\n", 1'000);
  EXPECT_THROW(read_mmcif_assemblies({"a.cif", cif}), CapacityError);
}

TEST(Bombs, PatchesForEveryResidue) {
  const Bounds bounds;
  std::string text;
  for (int n = 0; n < 4'000; ++n) text += "RESI R" + std::to_string(n) + " 0\nATOM A T 0\n";
  text += "PRES P 0\n";
  for (int n = 0; n < 4'000; ++n) text += "ATOM B" + std::to_string(n) + " T 0\n";
  text += "NONBONDED nbxmod\nT 0 0 1.5\n";
  const ScratchFile file("bomb.rtf");
  EXPECT_THROW(read_radii_files({file.write(text)}), CapacityError);
}

TEST(Bombs, ListsOfFrames) {
  const Bounds bounds;
  EXPECT_THROW(parse_frame_list("--frames", "0-99999999", 100'000'000), RequestError);
  EXPECT_THROW(parse_frame_list("--frames", "all", ~std::uint64_t{0}), RequestError);
  EXPECT_THROW(parse_frame_list("--frames", "0-9999999,10000000", 100'000'000), RequestError);
  EXPECT_EQ(parse_frame_list("--frames", "0-99999999:100000", 100'000'000).size(), 1'000u);
}

// Records have 2^64 bytes, which is 0 in 64-bit numbers, and other sizes are divided by it.
TEST(Bombs, NetcdfRecordsOf64Bits) {
  test::ByteWriter file(std::endian::big);
  const auto name = [&](const std::string& text) {
    file.put(std::uint64_t{text.size()}).put_text(text).put_text(std::string((4 - text.size() % 4) % 4, '\0'));
  };
  file.put_text("CDF\5").put(std::uint64_t{1});
  file.put(std::uint32_t{10}).put(std::uint64_t{4});
  const std::pair<const char*, std::uint64_t> dimensions[] = {
      {"frame", 0}, {"atom", 1}, {"spatial", 3}, {"many", std::uint64_t{1} << 47}};
  for (const auto& [word, length] : dimensions) {
    name(word);
    file.put(length);
  }
  file.put(std::uint32_t{12}).put(std::uint64_t{1});
  name("Conventions");
  file.put(std::uint32_t{2});
  name("AMBER");
  constexpr std::uint64_t kVariables = (1 << 14) + 1;
  file.put(std::uint32_t{11}).put(kVariables);
  for (std::uint64_t n = 0; n < kVariables; ++n) {
    const bool atoms = n + 1 == kVariables;  // coordinates with 12 bytes a record
    name(atoms ? "coordinates" : std::to_string(n));
    file.put(std::uint64_t{atoms ? 3u : 2u}).put(std::uint64_t{0}).put(std::uint64_t{atoms ? 1u : 3u});
    if (atoms) file.put(std::uint64_t{2});
    file.put(std::uint32_t{0}).put(std::uint64_t{0});
    file.put(std::uint32_t{atoms ? 5u : 6u}).put(std::uint64_t{0}).put(std::uint64_t{0});
  }
  file.put_text(std::string(64, '\0'));
  const ScratchFile scratch("bomb.nc");
  EXPECT_THROW(kAmberNetcdfFormat.open(scratch.write(file.bytes()), {}), InputError);
}

// The only number with a negative absolute value was once residue 0.
TEST(Bombs, ResidueNumbersOf64Bits) {
  const auto pqr = [](const std::string& residue) { return "ATOM 1 C ALA " + residue + " 1 2 3 0.1 1.5\n"; };
  const auto psf = [](const std::string& residue) {
    return "PSF\n\n1 !NATOM\n1 A " + residue + " ALA CA CT1 0.07 12.011 0\n\n0 !NBOND: bonds\n";
  };
  const std::string most = "-9223372036854775808";
  EXPECT_EQ(kPqrReader.read({"a.pqr", pqr("-3")}, {}).atoms.at(0).residue_number, -3);
  EXPECT_EQ(kPsfReader.read({"a.psf", psf("-3")}, {}).atoms.at(0).residue_number, -3);
  EXPECT_THROW(kPqrReader.read({"a.pqr", pqr(most)}, {}), InputError);
  EXPECT_THROW(kPsfReader.read({"a.psf", psf(most)}, {}), InputError);
}

}  // namespace
}  // namespace meniscus::fuzz
