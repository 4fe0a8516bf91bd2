// SPDX-License-Identifier: BSD-3-Clause
// Numbers and tables of many threads equal those of one thread.
#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <sys/mman.h>

#include "core/math/union_find.h"
#include "core/surface/parallel_tables.h"

namespace meniscus::testing {
namespace {

TEST(RowNumbers, AreTheSumsBefore) {
  for (const std::size_t rows : {0u, 1u, 511u, 512u, 513u, 5000u}) {
    const auto count = [](std::size_t n) { return static_cast<std::uint32_t>(n * 7 % 5); };
    const RowNumbers<std::uint32_t> numbers(rows, 100, count);
    std::vector<std::uint32_t> found(rows), expected(rows);
    numbers.for_each([&](std::size_t n, std::uint32_t& next) {
      found[n] = next;
      next += count(n);
    });
    std::uint32_t sum = 100;
    for (std::size_t n = 0; n < rows; ++n) {
      expected[n] = sum;
      sum += count(n);
    }
    EXPECT_EQ(found, expected) << rows << " rows";
    EXPECT_EQ(numbers.past(), sum) << rows << " rows";
  }
}

struct TableRow {
  std::uint32_t number = 7;
  double rest[3] = {};
};

// Tables are short, or so long that all threads request their memory.
TEST(LargeTables, HaveTheRowsOfAnyTable) {
  for (const std::size_t size : {0u, 1u, 1000u, 1500000u}) {
    std::vector<TableRow> table;
    resize_large(table, size);
    ASSERT_EQ(table.size(), size);
    EXPECT_TRUE(std::ranges::all_of(table, [](const TableRow& row) { return row.number == 7 && row.rest[2] == 0; }));
  }
}

// The system gets requests for all whole pages between two shared ones, and for no others.
TEST(LargeTables, GetTheirMemoryBeforeItIsWritten) {
  constexpr std::size_t kPage = 4096, kPages = 10000;
  void* const memory = ::mmap(nullptr, kPages * kPage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  char* const begin = static_cast<char*>(memory);
  populate(begin + kPage / 2, (kPages - 3) * kPage);
  std::vector<unsigned char> there(kPages);
  ASSERT_EQ(::mincore(memory, kPages * kPage, there.data()), 0);
  const auto count = std::ranges::count_if(there, [](unsigned char page) { return (page & 1) != 0; });
#ifdef MADV_POPULATE_WRITE
  const bool known = ::madvise(memory, kPage, MADV_POPULATE_WRITE) == 0;
#else
  const bool known = false;
#endif
  EXPECT_EQ(count, known ? static_cast<std::ptrdiff_t>(kPages - 4) : 0) << "pages";
  ::munmap(memory, kPages * kPage);
}

}  // namespace
}  // namespace meniscus::testing
