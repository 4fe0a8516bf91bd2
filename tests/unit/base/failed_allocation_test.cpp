// SPDX-License-Identifier: BSD-3-Clause
// Objects must end well if `new` gets no memory, at any allocation.
#include <cstdlib>
#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "core/base/output_file.h"
#include "core/base/progress.h"
#include "tests/support/run_program.h"

namespace {

int allocations_left = -1;  // number of allocations that succeed; negative: all do

void* allocate(std::size_t size) {
  if (allocations_left == 0) throw std::bad_alloc();
  if (allocations_left > 0) --allocations_left;
  void* const memory = std::malloc(size ? size : 1);
  if (!memory) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace meniscus {
namespace {

using test::TemporaryFolder;
using Names = std::vector<std::string>;

/// Returns whether the work comes to its end with so many allocations.
template <typename Work>
bool ends_with(int allocations, const Work& work) {
  allocations_left = allocations;
  bool whole = true;
  try {
    work();
  } catch (const std::bad_alloc&) {
    whole = false;
  }
  allocations_left = -1;
  return whole;
}

constexpr int kMany = 1000;

TEST(StageClock, EndsStagesWithoutMemory) {
  const std::string outer = "a stage with a name that is too long for a string without memory of its own";
  const std::string inner = outer + ", and one within it";
  bool whole = false;
  for (int allocations = 0; !whole; ++allocations) {
    ASSERT_LT(allocations, kMany);
    StageClock clock;
    whole = ends_with(allocations, [&] {
      const auto first = clock.stage(outer);
      const auto second = clock.stage(inner);
      allocations_left = 0;
    });
    if (!whole) continue;
    ASSERT_EQ(clock.times().size(), 2u);
    EXPECT_EQ(clock.times()[0].name, inner);
    EXPECT_EQ(clock.times()[1].name, outer);
  }
}

TEST(OutputFile, LeavesNothingWithoutMemory) {
  bool whole = false;
  for (int allocations = 0; !whole; ++allocations) {
    ASSERT_LT(allocations, kMany);
    const TemporaryFolder folder;
    const std::filesystem::path target = folder.path() / "a_file_with_a_name_of_some_length.txt";
    whole = ends_with(allocations, [&] {
      OutputFile file(target, Existing::refuse);
      file.write("whole");
      file.commit();
    });
    EXPECT_EQ(folder.entries(), whole ? Names{target.filename().string()} : Names{}) << allocations;
  }
}

TEST(OutputFolder, LeavesNothingWithoutMemory) {
  bool whole = false;
  for (int allocations = 0; !whole; ++allocations) {
    ASSERT_LT(allocations, kMany);
    const TemporaryFolder folder;
    const std::filesystem::path target = folder.path() / "a_folder_with_a_name_of_some_length" / "scene";
    whole = ends_with(allocations, [&] {
      OutputFolder scene(target, Existing::refuse);
      scene.file("scene.inc").write("1");
      scene.file("scene.pov").write("2");
      scene.commit();
    });
    EXPECT_EQ(std::filesystem::exists(target / "scene.pov"), whole) << allocations;
    EXPECT_EQ(folder.entries().empty(), !whole) << allocations;
  }
}

TEST(OutputFolder, IsRemovedWithoutMemoryWhenTheProgramEnds) {
  const TemporaryFolder folder;
  OutputFolder scene(folder.path() / "a" / "b", Existing::refuse);
  scene.file("scene.pov").write("2");
  const auto end = [&] {
    const bool ended = ends_with(0, [] { remove_unfinished_outputs(); });
    ::_exit(ended && folder.entries().empty() ? 0 : 1);
  };
  EXPECT_EXIT(end(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace meniscus
