// SPDX-License-Identifier: BSD-3-Clause
// The size of the memory: that of the machine, or less because of control groups.
#include "app/process/program_main.h"

#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/run_program.h"

namespace meniscus {
namespace {

TEST(MemorySize, IsThatOfTheMachineOrLess) {
  EXPECT_GT(memory_size(), std::uint64_t{1} << 20);
  EXPECT_LE(memory_size(), static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                               static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)));
}

std::uint64_t limit_of(const std::string& groups, const std::filesystem::path& mounted) {
  std::istringstream lines(groups);
  return memory_limit(lines, mounted);
}

TEST(MemorySize, IsLimitedByTheControlGroupAndByThoseItLiesIn) {
  const test::TemporaryFolder folder;
  const auto& root = folder.path();
  std::filesystem::create_directories(root / "job/step");
  std::filesystem::create_directories(root / "memory/slurm/job");
  folder.file("job/step/memory.max", "max\n");
  folder.file("job/memory.max", "3000000000\n");
  folder.file("memory/slurm/job/memory.limit_in_bytes", "9223372036854771712\n");
  folder.file("memory/slurm/memory.limit_in_bytes", "2000000000\n");
  EXPECT_EQ(limit_of("0::/job/step\n", root), 3'000'000'000u);
  EXPECT_EQ(limit_of("5:cpu,cpuacct:/slurm\n4:memory:/slurm/job\n", root), 2'000'000'000u);
  EXPECT_EQ(limit_of("4:memory:/slurm/job\n0::/job/step\n", root), 2'000'000'000u);
  EXPECT_EQ(limit_of("0::/elsewhere\n", root), UINT64_MAX);
  EXPECT_EQ(limit_of("0::/\n", root), UINT64_MAX);
  EXPECT_EQ(limit_of("nonsense\n", root), UINT64_MAX);
}

}  // namespace
}  // namespace meniscus
