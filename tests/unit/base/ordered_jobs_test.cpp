// SPDX-License-Identifier: BSD-3-Clause
// What making frames at once rests on: jobs with results in order, and how much memory there is.
#include <atomic>
#include <chrono>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "app/process/memory_size.h"
#include "core/base/ordered_jobs.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

using Jobs = OrderedJobs<int, int>;

void rest(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

TEST(OrderedJobs, ResultsComeInTheOrderOfTheJobsNotOfTheirEnds) {
  std::atomic<int> at_work = 0, most_at_work = 0;
  const auto worker = [&](int n) {
    most_at_work = std::max(most_at_work.load(), ++at_work);
    rest(n == 0 ? 60 : n % 3);
    --at_work;
    if (n % 5 == 2) throw std::runtime_error(std::to_string(n));
    return n;
  };
  Jobs jobs({worker, worker, worker});
  for (int n = 0; n < 20; ++n) jobs.begin(n);
  EXPECT_EQ(jobs.pending(), 20u);
  for (int n = 0; n < 20; ++n) {
    if (n % 5 != 2) {
      EXPECT_EQ(jobs.take(), n);
      continue;
    }
    try {
      jobs.take();
      ADD_FAILURE() << n;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), std::to_string(n));
    }
  }
  EXPECT_EQ(jobs.pending(), 0u);
  EXPECT_GT(most_at_work, 1);
}

TEST(OrderedJobs, ASingleWorkerWorksOnTheThreadOfTheCaller) {
  const std::thread::id caller = std::this_thread::get_id();
  Jobs jobs({[&](int n) { return std::this_thread::get_id() == caller ? n : -1; }});
  for (int n = 0; n < 3; ++n) jobs.begin(n);
  for (int n = 0; n < 3; ++n) EXPECT_EQ(jobs.take(), n);
}

TEST(OrderedJobs, WhatNobodyHasBegunIsDropped) {
  std::atomic<int> done = 0;
  const auto worker = [&](int n) {
    rest(20);
    ++done;
    return n;
  };
  {
    Jobs jobs({worker, worker});
    for (int n = 0; n < 1000; ++n) jobs.begin(n);
    EXPECT_EQ(jobs.take(), 0);
  }
  EXPECT_LT(done, 100);
}

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
