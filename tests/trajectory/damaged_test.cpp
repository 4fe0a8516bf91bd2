// SPDX-License-Identifier: BSD-3-Clause
// Reading damaged trajectories ends in frames of finite numbers or in one of our errors, whichever bytes are damaged,
// and never takes much memory.
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <random>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "tests/support/run_program.h"
#include "tests/support/sanitized.h"
#include "tests/trajectory/samples.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

using Random = std::mt19937;
using namespace std::string_literals;

std::size_t below(Random& random, std::size_t bound) {
  return std::uniform_int_distribution<std::size_t>(0, bound - 1)(random);
}

/// Damages a file: overwrites a byte or four with awkward numbers, cuts, takes out, repeats.
void damage(std::string& bytes, Random& random) {
  static const std::string kNumbers[] = {std::string(4, '\0'), "\xff\xff\xff\xff",  "\x7f\xff\xff\xff",
                                         "\x80\x00\x00\x00"s,  "\xff\xff\xff\x7f",  "\x00\x00\x00\x80"s,
                                         "\x7f\xc0\x00\x00"s,  "\x00\x00\xc0\x7f"s, "\x00\x00\x00\x01"s,
                                         "\x01\x00\x00\x00"s,  "\x40\x00\x00\x00"s, "\x00\x00\x00\x40"s};
  if (bytes.empty()) return;
  const std::size_t place = below(random, bytes.size());
  const std::size_t length = std::min(bytes.size() - place, 1 + below(random, 40));
  switch (below(random, 6)) {
    case 0:
      bytes[place] = static_cast<char>(below(random, 256));
      break;
    case 1:
      bytes[place] = static_cast<char>(bytes[place] ^ (1 << below(random, 8)));
      break;
    case 2:
      bytes.resize(place);
      break;
    case 3:
      below(random, 2) == 0 ? bytes.erase(place, length) : bytes.insert(place, bytes.substr(place, length));
      break;
    default: {
      const std::string& number = kNumbers[below(random, std::size(kNumbers))];
      const std::size_t aligned = place / 4 * 4;
      if (aligned + 4 <= bytes.size()) bytes.replace(aligned, 4, number);
    }
  }
}

/// Limits memory to 256 MB more than the process has, for the life of this object; not in a build with sanitizers.
class BoundedMemory {
 public:
  BoundedMemory() {
    getrlimit(RLIMIT_AS, &before_);
    if (test::kSanitized) return;
    rlimit bounded = before_;
    std::size_t pages = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
      EXPECT_EQ(std::fscanf(file, "%zu", &pages), 1);
      std::fclose(file);
    }
    bounded.rlim_cur = pages * 4096 + (std::size_t{256} << 20);
    setrlimit(RLIMIT_AS, &bounded);
  }
  ~BoundedMemory() { setrlimit(RLIMIT_AS, &before_); }
  BoundedMemory(const BoundedMemory&) = delete;
  BoundedMemory& operator=(const BoundedMemory&) = delete;

 private:
  rlimit before_{};
};

struct Outcomes {
  int opened = 0, refused = 0, frames = 0, bad_frames = 0;
};

void read_all(const std::string& path, Outcomes& outcomes) {
  std::unique_ptr<Trajectory> trajectory;
  try {
    trajectory = open_trajectory(path);
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
    ++outcomes.refused;
    return;
  }
  ++outcomes.opened;
  Frame frame;
  for (std::uint64_t n = 0; n < std::min<std::uint64_t>(trajectory->frame_count(), 50); ++n) {
    try {
      trajectory->read(n, frame);
      EXPECT_EQ(frame.positions.size(), trajectory->atom_count());
      for (const glm::dvec3& position : frame.positions)
        EXPECT_TRUE(std::isfinite(position.x + position.y + position.z));
      ++outcomes.frames;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
      ++outcomes.bad_frames;
    }
  }
}

void expect_no_harm(const std::string& name, const std::string& whole, int copies = 400) {
  const test::TemporaryFolder folder;
  const BoundedMemory bound;
  Outcomes outcomes;
  for (int seed = 0; seed < copies; ++seed) {
    Random random(static_cast<unsigned>(seed));
    std::string bytes = whole;
    for (std::size_t n = 1 + below(random, 3); n > 0; --n) damage(bytes, random);
    read_all(folder.file(name, bytes), outcomes);
  }
  EXPECT_GT(outcomes.opened, 0);
  EXPECT_GT(outcomes.refused, 0);
  EXPECT_GT(outcomes.frames, 0);
  EXPECT_GT(outcomes.bad_frames, 0);
}

TEST(DamagedTrajectory, Dcd) {
  expect_no_harm("a.dcd", test::dcd({}));
  expect_no_harm("a.dcd",
                 test::dcd({.order = std::endian::big, .marker = 8, .free = {2, 4}, .cell = {9, 0, 9, 0, 0, 9}}));
}

TEST(DamagedTrajectory, Xtc) {
  expect_no_harm("a.xtc", test::xtc({}));
  expect_no_harm("a.xtc", test::xtc({.atoms = 60, .magic = 2023, .spread = 10'000'000}));
}

TEST(DamagedTrajectory, Trr) { expect_no_harm("a.trr", test::trr({})); }

TEST(DamagedTrajectory, AmberNetcdf) {
  expect_no_harm("a.nc", test::amber_netcdf({}));
  expect_no_harm("a.nc", test::amber_netcdf({.version = 5}));
}

TEST(DamagedTrajectory, TextFrames) {
  const std::string gro =
      "t= 1\n    2\n    1SOL     OW    1   0.126   1.624   1.679\n    1SOL    HW1    2   0.190   1.661   1.747\n 1 1 "
      "1\n";
  expect_no_harm("a.gro", gro + gro + gro, 200);
  const std::string xyz = "2\nLattice=\"1 0 0 0 1 0 0 0 1\"\nC 0.5 -1.5 2\nC 1 2 3\n";
  expect_no_harm("a.xyz", xyz + xyz + xyz, 200);
  const std::string pdb =
      "MODEL        1\nATOM      1  N   THR A   1      17.047  14.099   3.625  1.00 13.79           N\n"
      "ATOM      2  CA  THR A   1      16.967  12.784   4.338  1.00 10.80           C\nENDMDL\n";
  expect_no_harm("a.pdb", "CRYST1   40.960   18.650   22.520  90.00  90.77  90.00 P 1\n" + pdb + pdb + pdb, 200);
}

}  // namespace
}  // namespace meniscus
