// SPDX-License-Identifier: BSD-3-Clause
// Every seed and every former crash runs through the same targets without a fuzzer, in any build.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "app/farm/bundle.h"
#include "tests/fuzz/target.h"
#include "tests/support/run_program.h"

namespace meniscus::fuzz {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Replays the target's files in this folder and returns their number.
std::size_t replay(const Target& target, const char* folder) {
  std::size_t count = 0;
  const fs::path inputs = fs::path(test::test_file("fuzz")) / folder / target.name;
  if (!fs::exists(inputs)) return 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(inputs)) {
    SCOPED_TRACE(entry.path().string());
    EXPECT_NO_THROW(target.run(content_of(entry.path())));
    ++count;
  }
  return count;
}

class FuzzReplay : public testing::TestWithParam<Target> {};

TEST_P(FuzzReplay, SeedsAndCrashes) {
  EXPECT_GT(replay(GetParam(), "seeds"), 0u) << "a target without seeds finds little";
  replay(GetParam(), "crashes");
  for (const char* bytes : {"", "\n", "{", "\xff\xfe"}) EXPECT_NO_THROW(GetParam().run(bytes));
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzReplay, testing::ValuesIn(targets().begin(), targets().end()),
                         [](const auto& target) { return std::string(target.param.name); });

/// A new required key of bundles would make seeds fail early, so that later code is never reached.
TEST(FuzzInputs, SeedsOfBundlesAreBundles) {
  const ScratchFile scratch("bundle.json");
  for (const fs::directory_entry& seed :
       fs::directory_iterator(fs::path(test::test_file("fuzz")) / "seeds" / "bundle")) {
    scratch.write(content_of(seed.path()));
    EXPECT_NO_THROW(farm::read_bundle(scratch.folder())) << seed.path();
  }
}

/// No test would replay a folder that belongs to no target.
TEST(FuzzInputs, BelongToTargets) {
  for (const char* folder : {"seeds", "crashes"}) {
    for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(test::test_file("fuzz")) / folder)) {
      if (!entry.is_directory()) continue;
      EXPECT_NE(std::ranges::find(targets(), entry.path().filename().string(),
                                  [](const Target& target) { return std::string(target.name); }),
                targets().end())
          << entry.path();
    }
  }
}

}  // namespace
}  // namespace meniscus::fuzz
