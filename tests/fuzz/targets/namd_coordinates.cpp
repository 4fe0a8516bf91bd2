// SPDX-License-Identifier: BSD-3-Clause
// Coordinate files of NAMD, of any byte order.
#include "tests/fuzz/trajectory_checks.h"

namespace meniscus::fuzz {
namespace {

void run_namd_coordinates(std::string_view bytes) {
  static const ScratchFile file("input.coor");
  check_trajectory(kNamdCoordinatesFormat, file, bytes);
}

const Registration registered_namd_coordinates{"namd_coordinates", run_namd_coordinates};

}  // namespace
}  // namespace meniscus::fuzz
