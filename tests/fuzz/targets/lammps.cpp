// SPDX-License-Identifier: BSD-3-Clause
// Text dumps of LAMMPS.
#include "tests/fuzz/trajectory_checks.h"

namespace meniscus::fuzz {
namespace {

void run_lammps(std::string_view bytes) {
  static const ScratchFile file("input.lammpstrj");
  check_trajectory(kLammpsFormat, file, bytes);
}

const Registration registered_lammps{"lammps", run_lammps};

}  // namespace
}  // namespace meniscus::fuzz
