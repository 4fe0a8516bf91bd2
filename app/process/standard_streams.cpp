// SPDX-License-Identifier: BSD-3-Clause
// Holds the places of closed streams with /dev/null, opened the wrong way round.
#include "app/process/standard_streams.h"

#include <iostream>

#include <fcntl.h>
#include <unistd.h>

#include "core/base/error.h"

namespace meniscus {

void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // The lowest free number is taken, and those below are in use. If even /dev/null is missing, so be it.
    [[maybe_unused]] const int held = ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

void finish_standard_output() {
  std::cout.flush();
  if (!std::cout) throw OutputError("standard output", "cannot be written");
}

}  // namespace meniscus
