// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in DCD.
#include "tests/fuzz/trajectory_checks.h"

namespace meniscus::fuzz {
namespace {

void run(std::string_view bytes) {
  static const ScratchFile file("input.dcd");
  check_trajectory(kDcdFormat, file, bytes);
}

const Registration registration{"dcd", run};

}  // namespace
}  // namespace meniscus::fuzz
