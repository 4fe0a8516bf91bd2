// SPDX-License-Identifier: BSD-3-Clause
// The first and the last steps of a program, in their order.
#include "app/process/program_main.h"

#include <iostream>

#include <unistd.h>

#include "app/process/error_report.h"
#include "app/process/failed_allocation.h"
#include "app/process/freed_memory.h"
#include "app/process/memory_limit.h"
#include "app/process/standard_streams.h"
#include "app/process/stop_signals.h"

namespace meniscus {

int program_main(const char* name, const std::function<ExitCode()>& work) {
  libraries_are_loaded();
  keep_freed_memory();
  ExitCode code = kExitOk;
  try {
    remember_failed_allocations();
    report_errors_as(name);
    report_uncaught_errors();
    hold_standard_streams();
    clean_up_on_signals();
    code = work();
  } catch (...) {
    code = report_current_error();
  }
  // Without memory no destructor of a library can be relied on: a thread of OpenBLAS that gets none asks again for
  // ever, and its destructor waits for it.
  if (memory_is_limited() || code == kExitCapacity) {
    std::cout.flush();
    ::_exit(code);
  }
  return code;
}

}  // namespace meniscus
