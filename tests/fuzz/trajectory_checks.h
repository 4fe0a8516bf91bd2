// SPDX-License-Identifier: BSD-3-Clause
// Conditions that every reader of trajectories must meet for any input.
#pragma once

#include <string_view>

#include "core/trajectory/formats/trajectory_formats.h"
#include "tests/fuzz/target.h"

namespace meniscus::fuzz {

/// Opens the bytes as this format and reads frames, some of them twice: numbers are finite, boxes have a shortest
/// image, and frames do not depend on earlier reads. `file`: the name has the format's extension.
void check_trajectory(const TrajectoryFormat& format, const ScratchFile& file, std::string_view bytes);

}  // namespace meniscus::fuzz
