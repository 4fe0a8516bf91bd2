// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in H5MD.
#include <hdf5.h>

#include "tests/fuzz/trajectory_checks.h"

namespace meniscus::fuzz {
namespace {

void run_h5md(std::string_view bytes) {
  static const ScratchFile file("input.h5md");
  check_trajectory(kH5mdFormat, file, bytes);
  require(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL) == 0, "nothing of a file stays open");
}

const Registration registered_h5md{"h5md", run_h5md};

}  // namespace
}  // namespace meniscus::fuzz
