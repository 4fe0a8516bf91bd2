// SPDX-License-Identifier: BSD-3-Clause
// A few atoms that move: frames for tests of runs.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/run_program.h"

namespace meniscus::test {

/// Models of a PDB file: four atoms whose last one walks away, and the whole of which turns and drifts. bad_frame: one
/// with a coordinate that is not a number.
std::string walk(int frames, int bad_frame = -1);

ProgramResult meniscus(const std::vector<std::string>& arguments);

/// With a file of eight frames in a folder of its own.
class WalkingAtoms : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  std::string file_ = folder_.file("walk.pdb", walk(8));
};

}  // namespace meniscus::test
