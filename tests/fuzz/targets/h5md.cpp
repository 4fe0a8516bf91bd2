// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in H5MD.
#include "tests/fuzz/trajectory_checks.h"

namespace meniscus::fuzz {
namespace {

void run(std::string_view bytes) {
  static const ScratchFile file("input.h5md");
  check_trajectory(kH5mdFormat, file, bytes);
}

const Registration registration{"h5md", run};

}  // namespace
}  // namespace meniscus::fuzz
