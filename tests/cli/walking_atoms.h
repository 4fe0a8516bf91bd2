// SPDX-License-Identifier: BSD-3-Clause
// A few atoms that move, as frames for tests of runs.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/run_program.h"

namespace meniscus::test {

/// Returns models of a PDB file: four atoms, the last of which walks away, while all turn and drift. bad_frame: a model
/// with a coordinate that is not a number.
std::string walk(int frames, int bad_frame = -1);

ProgramResult meniscus(const std::vector<std::string>& arguments);

/// A test with a file of eight frames in its own folder.
class WalkingAtoms : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  std::string file_ = folder_.file("walk.pdb", walk(8));
};

}  // namespace meniscus::test
