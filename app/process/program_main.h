// SPDX-License-Identifier: BSD-3-Clause
// The frame of each of our programs: its exit codes, first and last steps, signals that stop it, version and command
// line.
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
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
  kExitIncomplete = 8,  ///< a run of frames is done, but its trajectory ends in mid-frame
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
/// `exit_code`, if that is given. Younger handlers are called first, and the exit code of the youngest counts.
class StopHandler {
 public:
  StopHandler(std::function<void()> stop, std::optional<int> exit_code);
  ~StopHandler();
  StopHandler(const StopHandler&) = delete;
  StopHandler& operator=(const StopHandler&) = delete;
};

/// Returns a lock. While it is held no handler is called, so that the data of a handler changes as a whole. After a
/// signal the lock is never given again.
std::unique_lock<std::mutex> hold_stops();

/// Returns "0.1.0+g2b6bb4a4c1d2", the version and the commit; "....dirty.5f0c..." and a checksum if files differ from
/// it; "0.1.0+s77b1..." and a checksum of all sources where no repository tells. Programs with the same text are made
/// of the same sources.
const char* build_version();

/// Returns "2026-11-22", the day of the commit; without a repository, when CHANGELOG.md was last changed.
const char* build_date();

/// Returns the folder of the Blender add-on and of its driver, render_mns.py: share/meniscus/addon next to bin/, or
/// within the folder where the program was built. If neither is there, it returns the first.
std::filesystem::path addon_folder();

/// Keeps the words for command_line(). Call it once, before any other thread begins.
void remember_command_line(std::span<const char* const> words);

/// Returns the command line as a shell takes it, "meniscus 'render' '1tii.pdb' '-o' 'my picture.png'", the program
/// without its folder, control characters as \xNN. Empty if nothing was remembered.
std::string command_line();

/// Throws OutputError unless all that was printed has been taken. (Lines on standard error are no result: the program
/// continues if they cannot be written.)
void finish_standard_output();

/// Does the work of main() with memory, streams and signals prepared for errors, and returns its exit code. If an
/// exception leaves the work, its line on standard error begins with `name`, and the exit code is that of the
/// exception. The text of `name` must live as long as the program.
int program_main(const char* name, const std::function<ExitCode()>& work);

}  // namespace meniscus
