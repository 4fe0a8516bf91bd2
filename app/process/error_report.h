// SPDX-License-Identifier: BSD-3-Clause
// The one place where errors become a line on standard error and an exit code.
#pragma once

#include "app/process/program_error.h"

namespace meniscus {

/// Says what the exception that is being handled means; call in a catch clause. When there is no memory left to say it
/// with, it says that.
ExitCode report_current_error() noexcept;

/// Whose errors they are: what lines begin with instead of "meniscus". A name that lives as long as the program.
void report_errors_as(const char* program);

/// From now on an exception that nobody catches, on whatever thread, is reported like all others and ends the program
/// with its code, without unfinished files. (A thread of a library may run out of memory where no try block is ours.)
void report_uncaught_errors();

}  // namespace meniscus
