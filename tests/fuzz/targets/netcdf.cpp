// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in Amber's NetCDF.
#include "tests/fuzz/trajectory_checks.h"

namespace meniscus::fuzz {
namespace {

void run_netcdf(std::string_view bytes) {
  static const ScratchFile file("input.nc");
  check_trajectory(kAmberNetcdfFormat, file, bytes);
}

const Registration registered_netcdf{"netcdf", run_netcdf};

}  // namespace
}  // namespace meniscus::fuzz
