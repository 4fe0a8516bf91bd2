// SPDX-License-Identifier: BSD-3-Clause
// Restart files of Amber, as text.
#include "tests/fuzz/trajectory_checks.h"

namespace meniscus::fuzz {
namespace {

void run_amber_restart(std::string_view bytes) {
  static const ScratchFile file("input.rst7");
  check_trajectory(kAmberRestartFormat, file, bytes);
}

const Registration registered_amber_restart{"amber_restart", run_amber_restart};

}  // namespace
}  // namespace meniscus::fuzz
