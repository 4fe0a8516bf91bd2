// SPDX-License-Identifier: BSD-3-Clause
// What each of our programs does before and after its own work, with its standard streams among that.
#pragma once

#include <functional>

#include "app/process/program_error.h"

namespace meniscus {

/// Throws OutputError unless all that was printed has been taken. (What is said on standard error is no result: if it
/// cannot be said, the program goes on.)
void finish_standard_output();

/// For main(): makes ready for what may go wrong (memory, streams, signals), does the work, and gives the exit code:
/// that of the work, or that of the exception which left it, after a line on standard error that begins with `name`. A
/// name that lives as long as the program.
int program_main(const char* name, const std::function<ExitCode()>& work);

}  // namespace meniscus
