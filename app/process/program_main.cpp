// SPDX-License-Identifier: BSD-3-Clause
// The first and the last steps of a program, in their order; errors become a line for people and an exit code.
#include "app/process/program_main.h"

#include <atomic>
#include <exception>
#include <iostream>
#include <new>
#include <sstream>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "app/process/memory.h"
#include "app/process/program_error.h"
#include "app/process/stop_signals.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

constinit const char* program_name = "meniscus";

ExitCode say(ExitCode code, const std::string& message) {
  std::cerr << program_name << ": error: " << escaped(message) << std::endl;
  return code;
}

/// The lines of a selection with its caret.
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
    return fmt::format("the machine gives no more memory or threads: {}", error.what());
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
    return say(kExitInternal, "internal: an exception of a library; please report this");
  }
}

/// Needs no memory at all.
ExitCode report_without_memory() noexcept {
  constexpr std::string_view kLine =
      "meniscus: error: not enough memory; use a machine with more, a smaller molecule or picture, or fewer "
      "--threads\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kLine.data(), kLine.size());
  return kExitCapacity;
}

/// An exception that would leave a function which promises to throw none is no current one: nobody can ask what it is.
ExitCode report_unnamed_error() noexcept {
  if (memory_ran_out()) return report_without_memory();
  constexpr std::string_view kLine = "meniscus: error: internal: an exception where none may be; please report this\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kLine.data(), kLine.size());
  return kExitInternal;
}

/// Says what the exception that is being handled means, or, when there is no memory left to say it with, that.
ExitCode report_current_error() noexcept {
  try {
    return report_with_memory();
  } catch (const std::bad_alloc&) {
    return report_without_memory();
  } catch (...) {
    return kExitInternal;
  }
}

/// For exceptions that nobody catches: a thread of a library may run out of memory where no try block is ours.
/// Unfinished files are removed.
[[noreturn]] void end_by_uncaught_error() {
  static std::atomic_flag ending;
  while (ending.test_and_set()) ::pause();  // another thread says it already
  const ExitCode code = std::current_exception() ? report_current_error() : report_unnamed_error();
  remove_unfinished_outputs();
  ::_exit(code);
}

/// A standard stream that is closed gets a descriptor that nothing can be read from or written to, lest the next file
/// opened takes its number and messages are written into it.
void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // The lowest free number is taken, and those below are in use. If even /dev/null is missing, so be it.
    [[maybe_unused]] const int held = ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

}  // namespace

void finish_standard_output() {
  std::cout.flush();
  if (!std::cout) throw OutputError("standard output", "cannot be written");
}

int program_main(const char* name, const std::function<ExitCode()>& work) {
  libraries_are_loaded();
  keep_freed_memory();
  ExitCode code = kExitOk;
  try {
    remember_failed_allocations();
    program_name = name;
    std::set_terminate(end_by_uncaught_error);
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
