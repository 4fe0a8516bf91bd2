// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in Amber's NetCDF.
#include "tests/fuzz/trajectory_checks.h"

namespace meniscus::fuzz {
namespace {

void run(std::string_view bytes) {
  static const ScratchFile file("input.nc");
  check_trajectory(kAmberNetcdfFormat, file, bytes);
}

const Registration registration{"netcdf", run};

}  // namespace
}  // namespace meniscus::fuzz
