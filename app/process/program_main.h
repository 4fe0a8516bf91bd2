// SPDX-License-Identifier: BSD-3-Clause
// The common part of our programs: exit codes, first and last steps, signals that stop them, version and command line,
// and memory: how much they may use, and what happens when it runs out.
#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <istream>
#include <mutex>
#include <optional>
#include <span>

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
  kExitIncomplete = 8,  ///< a run of frames is done, but its trajectory ends within a frame
  kExitStopped = 9,     ///< a worker was stopped; the same command continues where it stopped
};

/// Returns the code that a program ends with because of this error.
ExitCode exit_code_of(const std::exception& error);

/// The error of a run of frames if some failed, or if its trajectory was cut short.
class RunError : public Error {
 public:
  template <typename... Values>
  RunError(ExitCode code, fmt::format_string<Values...> text, Values&&... values)
      : Error(fmt::format(text, std::forward<Values>(values)...)), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// The error of options that are wrong, alone or together.
class UsageError : public RequestError {
 public:
  using RequestError::RequestError;
};

/// While a StopHandler lives, these signals call its `stop` first, on a separate thread, and the program ends with its
/// `exit_code`, if that is given. Later handlers are called first, and the exit code of the latest counts.
class StopHandler {
 public:
  StopHandler(std::function<void()> stop, std::optional<int> exit_code);
  ~StopHandler();
  StopHandler(const StopHandler&) = delete;
  StopHandler& operator=(const StopHandler&) = delete;
};

/// Returns a lock. No handler is called while it is held, so that a handler's data changes in one step. After a signal
/// the lock is never free again.
std::unique_lock<std::mutex> hold_stops();

/// Returns "0.1.0+g2b6bb4a4c1d2", the version and the commit; "....dirty.5f0c..." with a checksum if files differ from
/// it; "0.1.0+s77b1..." with a checksum of all sources if there is no repository. Programs with the same text are made
/// from the same sources.
const char* build_version();

/// Returns "2026-11-22", the day of the commit; without a repository, when CHANGELOG.md was last changed.
const char* build_date();

/// Returns the folder of the Blender add-on and of its driver, render_mns.py: share/meniscus/addon next to bin/, or in
/// the folder where the program was built. If neither exists, it returns the first.
std::filesystem::path addon_folder();

/// Keeps the words for command_line(). Must be called once, before any other thread begins.
void remember_command_line(std::span<const char* const> words);

/// Returns the command line in the syntax of a shell, "meniscus 'render' '1tii.pdb' '-o' 'my picture.png'", with the
/// program's name without its folder, and control characters as \xNN; empty if no words were kept.
std::string command_line();

/// Throws OutputError unless all printed text has been written. (Lines on standard error are not a result: the program
/// continues if they cannot be written.)
void finish_standard_output();

/// Does the work of main() with memory, streams and signals prepared for errors, and returns its exit code. If the work
/// throws, a line on standard error begins with `name`, and the exit code is that of the exception. The text of `name`
/// must live as long as the program.
int program_main(const char* name, const std::function<ExitCode()>& work);

/// Returns the memory of the machine in bytes, or less if a control group of a container or the like allows less.
std::uint64_t memory_size();

/// Returns the smallest limit, in bytes, of control groups and of the groups around them; UINT64_MAX if there is no
/// limit. Lines of /proc/PID/cgroup name the groups (NUMBER:CONTROLLERS:/GROUP, cgroups(7)), which are mounted below
/// the given folder.
std::uint64_t memory_limit(std::istream& groups, const std::filesystem::path& mounted);

/// Notes that all libraries are loaded. Libraries do not survive a limit of memory or threads: some crash while they
/// are loaded, others wait forever for a thread that could not be started. Under such a limit, and only then, either
/// ends in a line on standard error and exit code 5; the wait is watched until this call at the beginning of main().
void libraries_are_loaded();

/// Returns true if there is such a limit.
bool memory_is_limited();

/// Remembers from now on if a `new` gets no memory; it still throws. Must be called at the beginning of main().
void remember_failed_allocations();

/// Returns true if a `new` got no memory since then. Requests of C libraries are not counted.
bool memory_ran_out() noexcept;

/// Keeps freed memory in the process, and takes tables of less than 32 MiB from it. Larger tables go back to the system
/// at once, so that the peak of memory grows by a few per cent only. New memory costs a page fault for each 4 KiB, a
/// tenth of the time of a small surface. Does nothing with C libraries that lack such a setting.
void keep_freed_memory();

}  // namespace meniscus
