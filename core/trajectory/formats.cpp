// SPDX-License-Identifier: BSD-3-Clause
// The choice among trajectory formats by what a file begins with.
#include "core/trajectory/formats.h"

#include <array>

namespace meniscus {
namespace {

/// A new format is a file read_<name>.cpp, its name in formats.h and an entry here, before the last.
constexpr std::array<const TrajectoryFormat*, 1> kFormats{&kModelsFormat};

}  // namespace

std::span<const TrajectoryFormat* const> trajectory_formats() { return kFormats; }

bool is_binary_trajectory(const std::string&) { return false; }

std::unique_ptr<Trajectory> open_trajectory(const std::string& path, const TrajectoryOptions& options) {
  return kFormats.back()->open(path, options);
}

}  // namespace meniscus
