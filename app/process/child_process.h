// SPDX-License-Identifier: BSD-3-Clause
// Child processes, which are started without a shell and end with this program: one is read line by line, one gets
// bytes; and the browser, which outlives it. child_process_posix.cpp (Linux, macOS) and child_process_windows.cpp start
// and end them.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/process/program_main.h"

namespace meniscus {

/// A child process. One thread makes and uses it and outlives it, since Linux ends a child when the *thread* that
/// started it ends; on Linux and Windows even kill -9 of this process leaves no child.
class ChildProcess {
 public:
  /// Starts arguments[0], which is searched in the absolute folders of PATH unless it has a slash; it runs in `folder`,
  /// with an empty standard input and no signal blocked. Throws InputError if it cannot be started.
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& folder);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Returns the next line of the child's output or error; nothing at their end. Lines are cut every 64 KiB.
  std::optional<std::string> next_line();

  /// Returns true if the child wrote something, or ended, within this time.
  bool has_news(std::chrono::milliseconds patience) const;

  /// Sends SIGTERM to the child; on Windows it ends at once.
  void stop() const;

  /// Waits for the end of the child and returns its exit code, or 128 + the signal that ended it. Call it once.
  int wait();

 private:
  int output_ = -1;
  std::intptr_t pid_ = -1;  ///< the number of the process; its handle on Windows
  std::string pending_;
};

/// A child process that this program feeds with bytes, such as ffmpeg with pictures.
class FedProcess {
 public:
  /// Starts words[0], which is searched in PATH; its standard output is discarded. Throws Error, "cannot be started: No
  /// such file or directory", without the program's name.
  explicit FedProcess(std::vector<std::string> words);
  ~FedProcess();
  FedProcess(const FedProcess&) = delete;
  FedProcess& operator=(const FedProcess&) = delete;

  /// Writes bytes to the child's standard input. Returns false if the child no longer reads.
  bool feed(std::span<const std::uint8_t> bytes);
  /// Closes the child's standard input, waits for its end, and returns its exit code; more calls return the same.
  int finish();
  /// Returns the first 2,000 bytes that the child wrote to its standard error.
  std::string complaints() const;

 private:
  /// Kills the child, and returns when it has ended, so that it writes nothing later.
  void kill() const;

  std::intptr_t pid_ = -1;
  int input_ = -1;       ///< a connection, so that writing to a child that died is an error, not a signal
  int complaints_ = -1;  ///< a file with the child's standard error
  int code_ = 0;
  StopHandler stop_{[this] { kill(); }, std::nullopt};
};

/// Runs a program that may outlive this one, such as a browser, and waits for its end. It has its own session, where
/// neither Ctrl-C nor the end of this program reaches it, and an empty standard input. Its output is discarded.
/// arguments: see ChildProcess. Returns the code of ChildProcess::wait(), or kNotStarted.
int run_apart(const std::vector<std::string>& arguments);
constexpr int kNotStarted = 127;

/// A code of wait() above this one means that a signal ended the child.
constexpr int kSignalCode = 128;

/// Returns the largest memory, in bytes, of a child that has ended; 0 if it is unknown.
std::uint64_t memory_of_largest_child();

/// Returns a text about such a code, "the process that made it was killed, as when memory runs out"; the next function
/// returns this program's own exit code for it: kExitCapacity for SIGKILL, else kExitInternal.
std::string signal_text(int code);
int signal_exit_code(int code);

/// Ends all children, at once with SIGTERM and after two seconds with SIGKILL (on Windows at once), and prevents that
/// others are started. The thread that ends the program calls it; the main thread may be anywhere.
void stop_children();

/// While a StopBarrier lives, stop_children() waits; once stop_children() has begun, the constructor never returns. The
/// main thread holds one when it writes files that the thread that ends the program removes, because a file could
/// otherwise be written after the removal. No child may be started or waited for meanwhile.
class StopBarrier {
 public:
  StopBarrier();
  ~StopBarrier();
  StopBarrier(const StopBarrier&) = delete;
  StopBarrier& operator=(const StopBarrier&) = delete;
};

/// Opens the address by the program that BROWSER names (not on Windows), or else by the desktop's program for it,
/// without a shell. The browser outlives this program. If none can be opened, `failed` is called with the reason, such
/// as "there is no display": on this thread or, later, on another one.
void open_in_browser(const std::string& address, std::function<void(const std::string& reason)> failed);

}  // namespace meniscus
