// SPDX-License-Identifier: BSD-3-Clause
// What a molecule file and a trajectory describe, on standard output: assemblies, frames, boxes.
#pragma once

#include "core/structure/structure.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {

/// On stdout.
void print_assemblies(const Structure& structure);

/// Prints atoms, frames, times, the box of the first frame, and where the file is cut short; warnings go to stderr.
void print_trajectory(Trajectory& trajectory);

}  // namespace meniscus
