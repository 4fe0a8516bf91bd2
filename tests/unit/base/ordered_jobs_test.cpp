// SPDX-License-Identifier: BSD-3-Clause
// Jobs that run at once give their results in the order in which they began.
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/ordered_jobs.h"

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

}  // namespace
}  // namespace meniscus
