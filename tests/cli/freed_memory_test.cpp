// SPDX-License-Identifier: BSD-3-Clause
// A frame that frees its tables leaves them to the next one, without page faults.
#include <cstdlib>
#include <memory>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "app/process/program_main.h"

namespace meniscus {
namespace {

long page_faults() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

/// Tables of half a megabyte to three, and one of thirty: all are held at once.
void compute_frame() {
  std::vector<std::unique_ptr<char[]>> tables;
  for (std::size_t n = 0; n < 20; ++n) tables.push_back(std::make_unique<char[]>((n % 6 + 1) * 512 * 1024));
  tables.push_back(std::make_unique<char[]>(30 * 1024 * 1024));
}

TEST(FreedMemory, ServesTheNextFrame) {
  keep_freed_memory();
  compute_frame();
  const long before = page_faults();
  for (int frame = 0; frame < 3; ++frame) compute_frame();
  EXPECT_LT(page_faults() - before, 500) << "of 16,000 pages a frame";
}

}  // namespace
}  // namespace meniscus
