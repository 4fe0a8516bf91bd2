// SPDX-License-Identifier: BSD-3-Clause
// The program's exit codes, and the error for options that exclude each other.
#pragma once

#include <exception>

#include "core/base/error.h"

namespace meniscus {

/// The exit codes of the program. They are documented in the help of `meniscus` and stable.
enum ExitCode : int {
  kExitOk = 0,
  kExitInternal = 1,
  kExitUsage = 2,
  kExitInput = 3,
  kExitGpu = 4,
  kExitCapacity = 5,
  kExitOutput = 6,
  kExitNotClosed = 7,
  kExitIncomplete = 8,  ///< a run of frames is done, but its trajectory ends in mid-frame
  kExitStopped = 9,     ///< a worker was stopped; the same command continues where it stopped
};

/// Returns the code that a program ends with because of this error.
ExitCode exit_code_of(const std::exception& error);

/// The error of a run of frames if some failed, or if its trajectory was cut short.
class RunError : public Error {
 public:
  RunError(ExitCode code, const std::string& message) : Error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// The error of options that are wrong, alone or together.
class UsageError : public RequestError {
 public:
  using RequestError::RequestError;
};

}  // namespace meniscus
