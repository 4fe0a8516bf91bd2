// SPDX-License-Identifier: BSD-3-Clause
// Runs the first and the last steps of a program in their order; errors become one line and an exit code.
#include "app/process/program_main.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "app/process/memory.h"
#include "app/process/program_error.h"
#include "app/process/stop_signals.h"
#include "app/process/system_process.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/system_file.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

constinit const char* program_name = "meniscus";

ExitCode say(ExitCode code, const std::string& message) {
  std::cerr << program_name << ": error: " << escaped(message) << std::endl;
  return code;
}

/// Prints an error of a selection, with the lines that show its place.
ExitCode say(const SelectionError& error) {
  std::istringstream picture(error.picture());
  std::string lines = escaped(error.sentence());
  for (std::string line; std::getline(picture, line);) lines.append("\n  ").append(escaped(line));
  std::cerr << program_name << ": error: " << lines << std::endl;
  return kExitUsage;
}

std::string sentence(const std::exception& error) {
  const ExitCode code = exit_code_of(error);
  if (code == kExitInternal) return fmt::format("internal: {}; please report this", error.what());
  if (code == kExitCapacity && !dynamic_cast<const Error*>(&error))
    return fmt::format("the system has no more memory or threads: {}", error.what());
  return error.what();
}

ExitCode report_with_memory() {
  try {
    throw;
  } catch (const SelectionError& error) {
    return say(error);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return say(exit_code_of(error), sentence(error));
  } catch (...) {
    return say(kExitInternal, "internal: unexpected exception of a library; please report this");
  }
}

/// Needs no memory at all.
ExitCode report_without_memory() noexcept {
  system_process::say(
      "meniscus: error: not enough memory; use a machine with more, a smaller molecule or picture, or fewer "
      "--threads\n");
  return kExitCapacity;
}

/// An exception that would leave a function which promises to throw none is no current one: nobody can ask what it is.
ExitCode report_unnamed_error() noexcept {
  if (memory_ran_out()) return report_without_memory();
  system_process::say("meniscus: error: internal: unexpected exception; please report this\n");
  return kExitInternal;
}

/// Reports the exception that is being handled, or the lack of memory if there is none left to report it with.
ExitCode report_current_error() noexcept {
  try {
    return report_with_memory();
  } catch (const std::bad_alloc&) {
    return report_without_memory();
  } catch (...) {
    return kExitInternal;
  }
}

/// Ends the program by an exception that was not caught: a thread of a library may run out of memory outside of all our
/// try blocks. Unfinished files are removed.
[[noreturn]] void end_by_uncaught_error() {
  static std::atomic_flag ending;
  while (ending.test_and_set()) system_file::wait_a_millisecond();  // another thread reports it already
  const ExitCode code = std::current_exception() ? report_current_error() : report_unnamed_error();
  remove_unfinished_outputs();
  system_process::end(code);
}

}  // namespace

void finish_standard_output() {
  errno = 0;
  std::cout.flush();
  if (!std::cout)
    throw OutputError("standard output",
                      std::string("cannot be written") + (errno != 0 ? std::string(": ") + std::strerror(errno) : ""));
}

int program_main(const char* name, const std::function<ExitCode()>& work) {
  libraries_are_loaded();
  keep_freed_memory();
  ExitCode code = kExitOk;
  try {
    remember_failed_allocations();
    program_name = name;
    std::set_terminate(end_by_uncaught_error);
    system_process::hold_standard_streams();
    clean_up_on_signals();
    code = work();
  } catch (...) {
    code = report_current_error();
  }
  // Destructors of libraries cannot be relied on if there is no memory: a thread of OpenBLAS that gets none tries again
  // for ever, and its destructor waits for it.
  if (memory_is_limited() || code == kExitCapacity) {
    std::cout.flush();
    system_process::end(code);
  }
  return code;
}

}  // namespace meniscus
