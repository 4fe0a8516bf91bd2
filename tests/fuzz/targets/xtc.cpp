// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in XTC.
#include "tests/fuzz/trajectory_checks.h"

namespace meniscus::fuzz {
namespace {

void run(std::string_view bytes) {
  static const ScratchFile file("input.xtc");
  check_trajectory(kXtcFormat, file, bytes);
}

const Registration registration{"xtc", run};

}  // namespace
}  // namespace meniscus::fuzz
