// SPDX-License-Identifier: BSD-3-Clause
// Formatted trajectories of Amber, of structures of few atoms.
#include "tests/fuzz/trajectory_checks.h"
#include "core/trajectory/trajectory.h"

namespace meniscus::fuzz {
namespace {

std::size_t atoms = 1;

std::unique_ptr<Trajectory> open(const std::string& path, const TrajectoryOptions&) {
  return kMdcrdFormat.open(path, {.index_folder = {}, .atoms = [] { return atoms; }});
}

/// Takes the number of atoms from the first letter of the title.
void run_mdcrd(std::string_view bytes) {
  static const ScratchFile file("input.mdcrd");
  atoms = bytes.empty() ? 1 : static_cast<unsigned char>(bytes.front()) % 32 + 1;
  check_trajectory({kMdcrdFormat.metadata, kMdcrdFormat.recognizes, open}, file, bytes);
}

const Registration registered_mdcrd{"mdcrd", run_mdcrd};

}  // namespace
}  // namespace meniscus::fuzz
