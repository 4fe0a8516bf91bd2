// SPDX-License-Identifier: BSD-3-Clause
// `meniscus surface --csv-summary`: numbers of many molecules, one row a file.
#pragma once

#include "app/commands/surface_command.h"

namespace meniscus {

/// Computes the molecule's file and, where a run has its trajectories, further ones, several at once. Rows go to
/// FILE.part, in the order of the files, each as soon as it is whole; at the end that becomes FILE. A file that cannot
/// be computed has a row that says why. Likewise rows of atoms and residues, which begin with the file. Throws
/// UsageError for what goes with one molecule alone, OutputError; at the end RunError, with the code of the first file
/// that failed.
void print_summary(const SurfaceCommand& command);

}  // namespace meniscus
