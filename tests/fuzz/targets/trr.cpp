// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in TRR.
#include "tests/fuzz/trajectory_checks.h"

namespace meniscus::fuzz {
namespace {

void run_trr(std::string_view bytes) {
  static const ScratchFile file("input.trr");
  check_trajectory(kTrrFormat, file, bytes);
}

const Registration registered_trr{"trr", run_trr};

}  // namespace
}  // namespace meniscus::fuzz
