// SPDX-License-Identifier: BSD-3-Clause
// When any call fails, the program ends with the right code and leaves whole files or none.
#include <algorithm>
#include <iterator>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/faults/faulty_run.h"

namespace meniscus::test {
namespace {

const std::vector<FaultCase> kComputing{
    {"json", {"surface", "{in}/four.xyzr", "--json", "-q", "--device", "cpu", "--threads", "1"}},
    {"csv",
     {"surface", "{in}/four.xyzr", "--csv", "{out}/a.csv", "--csv-residues", "{out}/r.csv", "-q", "--device", "cpu",
      "--threads", "1"}},
    {"frames", {"surface", "{in}/walk.pdb", "--frames", "all", "--json", "-q", "--device", "cpu", "--threads", "1"}},
    {"ply", {"export", "ply", "{in}/four.xyzr", "-o", "{out}/a.ply", "-q", "--device", "cpu", "--threads", "1"}},
    {"povray", {"export", "povray", "{in}/four.xyzr", "-o", "{out}/scene", "-q", "--device", "cpu", "--threads", "1"}},
    {"blender",
     {"export", "blender", "{in}/four.xyzr", "-o", "{out}/a.mns", "-q", "--device", "cpu", "--threads", "1"}}};

const std::vector<FaultCase> kPictures{
    {"png", {"render", "{in}/four.xyzr", "-o", "{out}/a.png", "-q", "--size", "32x24", "--samples", "1"}},
    {"tiff", {"render", "{in}/four.xyzr", "-o", "{out}/a.tif", "-q", "--size", "32x24", "--samples", "1"}},
    {"exr", {"render", "{in}/four.xyzr", "-o", "{out}/a.exr", "--aovs", "-q", "--size", "32x24", "--samples", "1"}}};

const std::vector<FaultCase> kFilms{
    {"mp4", {"render", "{in}/walk.pdb", "--frames", "all", "-o", "{out}/a.mp4", "-q", "--size", "32x24"}},
    {"mkv", {"render", "{in}/walk.pdb", "--frames", "all", "-o", "{out}/a.mkv", "-q", "--size", "32x24"}}};

std::vector<FaultCase> all_cases() {
  std::vector<FaultCase> cases;
  for (const auto& some : {kComputing, kPictures, kFilms}) cases.insert(cases.end(), some.begin(), some.end());
  return cases;
}

std::vector<std::uint64_t> one_to(std::uint64_t last) {
  std::vector<std::uint64_t> numbers(last);
  std::iota(numbers.begin(), numbers.end(), 1);
  return numbers;
}

std::string name_of(const testing::TestParamInfo<FaultCase>& info) { return info.param.name; }

void expect_promise_kept(FaultBench& bench, const Fault& fault, const std::vector<std::uint64_t>& numbers,
                         const std::vector<int>& codes) {
  int failed = 0;
  for (const std::uint64_t number : numbers) {
    Fault this_one = fault;
    this_one.at = number;
    const FaultyRun run = bench.run(this_one);
    failed += static_cast<int>(run.tally.failed);
    EXPECT_EQ(bench.broken_promise(run, codes), "") << fault.call << " " << fault.kind << " " << number;
  }
  // The n-th call may shift by a few between runs with several threads.
  EXPECT_GE(failed, static_cast<int>(numbers.size()) * 9 / 10) << fault.call << " " << fault.kind;
}

class FailingCalls : public ::testing::TestWithParam<FaultCase> {};

/// A way in which one kind of call fails, and the codes that the program may then end with.
struct Trouble {
  const char* call;
  std::vector<const char*> kinds;
  std::vector<int> codes;
};

// Checks a few calls of each kind, evenly spread.
void expect_promise_kept(const FaultCase& command, const std::vector<Trouble>& troubles) {
  constexpr std::size_t kMost = 4;
  FaultBench bench(command);
  for (const Trouble& trouble : troubles) {
    const std::uint64_t calls = bench.sound({trouble.call, ""}).tally.calls;
    for (const char* kind : trouble.kinds)
      expect_promise_kept(bench, {trouble.call, kind}, sampled(one_to(calls), kMost), trouble.codes);
  }
}

TEST_P(FailingCalls, EndWithTheRightCodeAndWholeFiles) {
  expect_promise_kept(GetParam(), {{"write", {"ENOSPC", "EIO"}, {6}},
                                   {"sync", {"EIO"}, {6}},
                                   {"rename", {"EIO"}, {6}},
                                   {"mkdir", {"ENOSPC"}, {6}},
                                   {"open", {"EIO"}, {3, 6}},
                                   {"read", {"EIO"}, {3, 6}}});
}

TEST_P(FailingCalls, AreMadeAgainWhenInterrupted) {
  expect_promise_kept(GetParam(), {{"write", {"EINTR", "short"}, {}},
                                   {"sync", {"EINTR"}, {}},
                                   {"rename", {"EINTR"}, {}},
                                   {"open", {"EINTR"}, {}},
                                   {"read", {"EINTR", "short"}, {}}});
}

INSTANTIATE_TEST_SUITE_P(Files, FailingCalls, testing::ValuesIn(all_cases()), name_of);

class FailingEncoder : public ::testing::TestWithParam<FaultCase> {};

// The encoder's own writes fail from one on, like on a full disk.
TEST_P(FailingEncoder, GivesNoFilm) {
  FaultBench bench(GetParam());
  const Fault fault{"write", "full", 0, "ffmpeg"};
  expect_promise_kept(bench, fault, sampled(one_to(bench.sound(fault).tally.calls), 4), {6});
}

INSTANTIATE_TEST_SUITE_P(Films, FailingEncoder, testing::ValuesIn(kFilms), name_of);

// Allocations fail, alone or with all later ones, at some of the different stacks of callers, evenly spread. The
// options of the program, which every command begins with, are a case of their own.
class FailingAllocations : public ::testing::TestWithParam<FaultCase> {
 protected:
  void check(const std::string& kind, std::size_t most) {
    FaultBench options({"options", {"--version"}}), bench(GetParam());
    const Fault fault{"allocate", kind};
    const bool has_work = GetParam().arguments.size() > 1;
    const std::uint64_t before = has_work ? options.sound(fault).tally.calls * 95 / 100 : 0;
    const Tally& tally = bench.sound(fault).tally;
    ASSERT_LT(tally.places, tally.first.size());
    std::vector<std::uint64_t> numbers;
    std::copy_if(tally.first.begin(), tally.first.begin() + tally.places, std::back_inserter(numbers),
                 [before](std::uint64_t number) { return number > before; });
    ASSERT_GT(numbers.size(), 100u);
    expect_promise_kept(bench, fault, sampled(numbers, most), {5});
  }
};

TEST_P(FailingAllocations, OneIsMissing) { check("once", 12); }
TEST_P(FailingAllocations, NoneIsLeft) { check("on", 8); }

// When oneTBB gets no memory, it may keep a lock for which its destructors then wait without end.
TEST(FailingAllocationsOfThreads, EndTheProgramToo) {
  FaultBench bench(kComputing.front());
  const Fault fault{"allocate", "once", 0, "meniscus", "libtbb.so"};
  const Tally& tally = bench.sound(fault).tally;
  ASSERT_GT(tally.places, 10u);
  expect_promise_kept(bench, fault, {tally.first.begin(), tally.first.begin() + tally.places}, {5});
}

INSTANTIATE_TEST_SUITE_P(Options, FailingAllocations, testing::Values(FaultCase{"version", {"--version"}}), name_of);
INSTANTIATE_TEST_SUITE_P(Computing, FailingAllocations, testing::ValuesIn(kComputing), name_of);
// The GL cases fail allocations of the program and of libraries that write pictures, but not those of the driver.
INSTANTIATE_TEST_SUITE_P(Pictures, FailingAllocations, testing::Values(kPictures.front()), name_of);

}  // namespace
}  // namespace meniscus::test
