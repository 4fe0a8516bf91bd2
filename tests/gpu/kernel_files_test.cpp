// SPDX-License-Identifier: BSD-3-Clause
// Kernels that were kept spare the compiler, and whatever is wrong with a file costs no more than that.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/gpu/buffer.h"
#include "core/gpu/egl_context.h"
#include "core/gpu/kernel_records.h"
#include "core/gpu/program.h"
#include "tests/gpu/gl_faults.h"
#include "tests/support/run_program.h"

namespace meniscus::testing {
namespace {

namespace fs = std::filesystem;

class KeptKernels : public ::testing::Test {
 protected:
  void TearDown() override { plan({}); }

  /// Writes multiples of `factor` in a context of its own; returns how many shaders that compiled.
  std::uint32_t compiled_for(const std::string& factor, const std::string& folder) {
    DeviceChoice choice;
    choice.kernel_folder = folder;
    const EglContext context(choice);
    plan({});
    const Program program("gpu_shaders/test_support/scale.comp", {{"FACTOR", factor}});
    Buffer words{std::span<const std::uint32_t>(std::vector<std::uint32_t>{9, 9, 9})}, surplus(4);
    words.bind(0);
    surplus.bind(1);
    program.set(kernel::ScaleParameters{.count = 3, .offset = 0});
    program.dispatch(1);
    const auto times = static_cast<std::uint32_t>(std::stoul(factor));
    EXPECT_EQ(words.download<std::uint32_t>(3), (std::vector<std::uint32_t>{0, times, 2 * times}));
    return calls_seen().shaders_compiled;
  }

  std::vector<fs::path> files() const {
    if (!fs::exists(kernels_)) return {};
    return {fs::directory_iterator(kernels_), fs::directory_iterator()};
  }

  test::TemporaryFolder folder_;
  fs::path kernels_ = folder_.path() / "made" / "kernels";
};

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_F(KeptKernels, AreCompiledOnce) {
  EXPECT_EQ(compiled_for("3", kernels_), 1u);
  EXPECT_EQ(files().size(), 1u);
  EXPECT_EQ(compiled_for("3", kernels_), 0u);
  EXPECT_EQ(compiled_for("4", kernels_), 1u);
  EXPECT_EQ(compiled_for("4", kernels_), 0u);
  EXPECT_EQ(files().size(), 2u) << "and nothing else is left there";
  EXPECT_EQ(compiled_for("3", ""), 1u) << "without a folder nothing is kept";
}

TEST_F(KeptKernels, AreCompiledWhereTheirFileIsDamaged) {
  ASSERT_EQ(compiled_for("3", kernels_), 1u);
  const fs::path path = files().front();
  const std::string whole = content_of(path);
  std::vector<std::string> damaged{"", "meniscus kernel 1\n", whole + "x"};
  for (const std::size_t length : {whole.size() - 1, whole.size() - 8, whole.size() / 2}) {
    damaged.push_back(whole.substr(0, length));
    damaged.push_back(whole);
    damaged.back()[length] ^= 1;
  }
  for (const std::string& content : damaged) {
    std::ofstream(path, std::ios::binary) << content;
    EXPECT_EQ(compiled_for("3", kernels_), 1u);
    EXPECT_EQ(compiled_for("3", kernels_), 0u) << "a good file takes its place";
  }
}

TEST_F(KeptKernels, AreNotMistakenForOthers) {
  ASSERT_EQ(compiled_for("3", kernels_), 1u);
  const fs::path of_3 = files().front();
  ASSERT_EQ(compiled_for("4", kernels_), 1u);
  const auto found = files();
  const fs::path of_4 = *std::ranges::find_if(found, [&](const fs::path& path) { return path != of_3; });
  fs::copy_file(of_3, of_4, fs::copy_options::overwrite_existing);
  EXPECT_EQ(compiled_for("4", kernels_), 1u);
}

TEST_F(KeptKernels, AreNoErrorWhereTheyCannotBeKept) {
  const std::string file = folder_.file("no_folder", "");
  EXPECT_EQ(compiled_for("3", file), 1u);
  EXPECT_EQ(compiled_for("3", file + "/kernels"), 1u);
  EXPECT_EQ(content_of(file), "");
}

}  // namespace
}  // namespace meniscus::testing
