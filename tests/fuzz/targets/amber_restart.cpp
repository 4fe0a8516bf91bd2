// SPDX-License-Identifier: BSD-3-Clause
// Restart files of Amber, as text.
#include "tests/fuzz/trajectory_checks.h"

namespace meniscus::fuzz {
namespace {

void run(std::string_view bytes) {
  static const ScratchFile file("input.rst7");
  check_trajectory(kAmberRestartFormat, file, bytes);
}

const Registration registration{"amber_restart", run};

}  // namespace
}  // namespace meniscus::fuzz
