// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in DCD.
#include "tests/fuzz/trajectory_checks.h"

namespace meniscus::fuzz {
namespace {

void run_dcd(std::string_view bytes) {
  static const ScratchFile file("input.dcd");
  check_trajectory(kDcdFormat, file, bytes);
}

const Registration registered_dcd{"dcd", run_dcd};

}  // namespace
}  // namespace meniscus::fuzz
