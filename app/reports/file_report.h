// SPDX-License-Identifier: BSD-3-Clause
// Prints what a molecule file and a trajectory contain on standard output: assemblies, frames, boxes.
#pragma once

#include "core/structure/structure.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {

/// Prints the assemblies of a structure on standard output.
void print_assemblies(const Structure& structure);

/// Prints atoms, frames, times, the box of the first frame, and where the file is cut short; warnings go to standard
/// error.
void print_trajectory(Trajectory& trajectory);

}  // namespace meniscus
