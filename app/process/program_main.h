// SPDX-License-Identifier: BSD-3-Clause
// The first and the last steps of each of our programs, among them the care for its standard streams.
#pragma once

#include <functional>

#include "app/process/program_error.h"

namespace meniscus {

/// Throws OutputError unless all that was printed has been taken. (Lines on standard error are no result: the program
/// continues if they cannot be written.)
void finish_standard_output();

/// Does the work of main() with memory, streams and signals prepared for errors, and returns its exit code. If an
/// exception leaves the work, its line on standard error begins with `name`, and the exit code is that of the
/// exception. The text of `name` must live as long as the program.
int program_main(const char* name, const std::function<ExitCode()>& work);

}  // namespace meniscus
