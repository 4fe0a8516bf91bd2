// SPDX-License-Identifier: BSD-3-Clause
// Messages about trajectories: `info`, and a trajectory in place of a molecule.
#include <gtest/gtest.h>

#include "tests/support/run_program.h"
#include "tests/trajectory/samples.h"

namespace meniscus {
namespace {

using test::ProgramResult;
using test::run_program;
using test::TemporaryFolder;

TEST(Info, TellsOfATrajectory) {
  const TemporaryFolder folder;
  const std::string bytes = test::dcd({.promised = 500, .cell = {10, 90, 20, 90, 90, 30}});
  const std::string path = folder.file("a.dcd", bytes.substr(0, bytes.size() - 3));
  const ProgramResult result = run_program(test::meniscus_program(), {"info", path});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* words :
       {"a.dcd (DCD)\n", "4 in each frame\n", "2 (0 to 1)\n", "steps         100 to 110\n",
        "10.000 20.000 30.000 Å, 90.00 90.00 90.00 degrees", "cut short     the file ends within frame 2"})
    EXPECT_NE(result.out.find(words), std::string::npos) << words << result.out;
  EXPECT_NE(result.err.find("its header says 500 frames, but it holds 2"), std::string::npos) << result.err;
}

TEST(Info, TellsOfATopologyWithItsTrajectory) {
  const TemporaryFolder folder;
  const std::string psf = folder.file("a.psf",
                                      "PSF\n\n 4 !NATOM\n1 A 1 LIG C1 C 0 12 0\n2 A 1 LIG C2 C 0 12 0\n"
                                      "3 A 1 LIG C3 C 0 12 0\n4 A 1 LIG C4 C 0 12 0\n\n 0 !NBOND\n");
  const std::string dcd = folder.file("a.dcd", test::dcd({}));
  const ProgramResult result = run_program(test::meniscus_program(), {"info", psf, "--trajectory", dcd});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("(PSF, 1 model)"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("a.dcd (DCD)"), std::string::npos) << result.out;
}

TEST(Trajectory, GivenAsMoleculeIsExplained) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program(test::meniscus_program(), {"surface", folder.file("a.dcd", test::dcd({}))});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("is a trajectory (DCD) and holds no atoms"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("--trajectory"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace meniscus
