// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in XTC.
#include "tests/fuzz/trajectory_checks.h"

namespace meniscus::fuzz {
namespace {

void run_xtc(std::string_view bytes) {
  static const ScratchFile file("input.xtc");
  check_trajectory(kXtcFormat, file, bytes);
}

const Registration registered_xtc{"xtc", run_xtc};

}  // namespace
}  // namespace meniscus::fuzz
