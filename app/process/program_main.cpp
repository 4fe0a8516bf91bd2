// SPDX-License-Identifier: BSD-3-Clause
// Runs the first and the last steps of a program in order, and turns errors into one line and an exit code.
#include "app/process/program_main.h"

#include <atomic>
#include <cstring>
#include <iostream>
#include <new>
#include <sstream>
#include <system_error>

#include "app/process/system_process.h"
#include "core/base/output_file.h"
#include "core/base/system_file.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

template <typename Kind>
bool is(const std::exception& error) {
  return dynamic_cast<const Kind*>(&error) != nullptr;
}

/// Returns the code for a request that the system refused: memory, another thread, or a change of a folder.
ExitCode code_of_system(const std::system_error& error) {
  if (error.code() == std::errc::not_enough_memory || error.code() == std::errc::resource_unavailable_try_again)
    return kExitCapacity;
  return is<std::filesystem::filesystem_error>(error) ? kExitOutput : kExitInternal;
}

}  // namespace

ExitCode exit_code_of(const std::exception& error) {
  if (const auto* run = dynamic_cast<const RunError*>(&error)) return run->code();
  if (is<RequestError>(error) || is<SelectionError>(error)) return kExitUsage;
  if (is<InputError>(error)) return kExitInput;
  if (is<GpuError>(error)) return kExitGpu;
  if (is<CapacityError>(error) || is<std::bad_alloc>(error)) return kExitCapacity;
  if (is<OutputError>(error)) return kExitOutput;
  if (is<OpenSurfaceError>(error)) return kExitNotClosed;
  if (std::string_view(error.what()).starts_with("pthread_create"))
    return kExitCapacity;  // these are the words of oneTBB
  if (const auto* system = dynamic_cast<const std::system_error*>(&error)) return code_of_system(*system);
  return kExitInternal;
}

namespace {

struct Registered {
  const StopHandler* handler;
  std::function<void()> stop;
  std::optional<int> exit_code;
};

struct Handling {
  std::mutex mutex;  // held from the signal to the end of the program, so that a handler outlives its call
  std::vector<Registered> all;
};

Handling& handling() {
  static Handling instance;
  return instance;
}

void stop(int signal) {
  const auto held = hold_stops();
  std::optional<int> exit_code;
  for (auto one = handling().all.rbegin(); one != handling().all.rend(); ++one) {
    one->stop();
    if (!exit_code) exit_code = one->exit_code;
  }
  remove_unfinished_outputs();
  system_process::end(exit_code.value_or(128 + signal));
}

/// Makes SIGINT, SIGTERM, SIGHUP and SIGUSR1 remove unfinished files before they end the program. SIGXFSZ is ignored,
/// so that a file too large is an OutputError. Must be called once, before other threads are started.
void clean_up_on_signals() { system_process::await_stop(stop); }

namespace fs = std::filesystem;

std::string& remembered() {
  static std::string line;
  return line;
}

}  // namespace

std::unique_lock<std::mutex> hold_stops() { return std::unique_lock(handling().mutex); }

StopHandler::StopHandler(std::function<void()> stop, std::optional<int> exit_code) {
  const auto held = hold_stops();
  handling().all.push_back({this, std::move(stop), exit_code});
}

StopHandler::~StopHandler() {
  const auto held = hold_stops();
  std::erase_if(handling().all, [this](const Registered& one) { return one.handler == this; });
}

std::filesystem::path addon_folder() {
  std::error_code none;
  const fs::path program = system_file::program_path().parent_path();
  const fs::path installed = program.parent_path() / "share/meniscus/addon", built = program / "share/meniscus/addon";
  return !fs::exists(installed, none) && fs::exists(built, none) ? built : installed;
}

void remember_command_line(std::span<const char* const> words) {
  std::string& line = remembered();
  line.clear();
  for (std::size_t n = 0; n < words.size(); ++n)
    line += n == 0 ? fs::path(words[0]).filename().string() : " " + escaped(shell_word(words[n]));
}

std::string command_line() { return remembered(); }

namespace {

constinit const char* program_name = "meniscus";

ExitCode print_error(ExitCode code, const std::string& message) {
  std::cerr << program_name << ": error: " << escaped(message) << std::endl;
  return code;
}

/// Prints an error of a selection, with lines that show its position.
ExitCode print_error(const SelectionError& error) {
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
    return print_error(error);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return print_error(exit_code_of(error), sentence(error));
  } catch (...) {
    return print_error(kExitInternal, "internal: unexpected exception of a library; please report this");
  }
}

/// Reports the lack of memory without using any.
ExitCode report_without_memory() noexcept {
  system_process::write_error(
      "meniscus: error: not enough memory; use a machine with more, a smaller molecule or picture, or fewer "
      "--threads\n");
  return kExitCapacity;
}

/// Reports an exception that escapes a noexcept function; it is not current, so its message is not available.
ExitCode report_unnamed_error() noexcept {
  if (memory_ran_out()) return report_without_memory();
  system_process::write_error("meniscus: error: internal: unexpected exception; please report this\n");
  return kExitInternal;
}

/// Reports the exception that is being handled, or the lack of memory if none is left to report it.
ExitCode report_current_error() noexcept {
  try {
    return report_with_memory();
  } catch (const std::bad_alloc&) {
    return report_without_memory();
  } catch (...) {
    return kExitInternal;
  }
}

/// Ends the program because of an uncaught exception, for instance in a thread of a library that ran out of memory.
/// Unfinished files are removed.
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
  // Destructors of libraries are not reliable without memory: a thread of OpenBLAS that gets none tries again forever,
  // and its destructor waits for it.
  if (memory_is_limited() || code == kExitCapacity) {
    std::cout.flush();
    system_process::end(code);
  }
  return code;
}

}  // namespace meniscus
