// SPDX-License-Identifier: BSD-3-Clause
// What `meniscus info` says of a trajectory.
#pragma once

#include "core/trajectory/trajectory.h"

namespace meniscus {

/// Prints atoms, frames, times, the box of the first frame, and where the file is cut short; oddities go to stderr.
void print_trajectory(Trajectory& trajectory);

}  // namespace meniscus
