// SPDX-License-Identifier: BSD-3-Clause
// A child process: started without a shell, read line by line, and ended when this program ends.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace meniscus {

/// One child. Made and used by one thread that outlives it, since Linux ends a child when the *thread* that started it
/// ends; even kill -9 of this process leaves none behind there.
class ChildProcess {
 public:
  /// arguments[0] is the program, looked for in the absolute folders of PATH unless it has a slash; it runs in
  /// `folder`, with an empty standard input and no signal blocked. Throws InputError if it cannot be started.
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& folder);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// The next line it writes, to standard output or error; nothing at their end. A line without
  /// end comes in pieces of 64 KiB.
  std::optional<std::string> next_line();

  /// Whether it wrote something, or has come to its end, within this time.
  bool has_news(std::chrono::milliseconds patience) const;

  /// Asks it to end, by SIGTERM.
  void stop() const;

  /// Waits for its end, once: its exit code, or 128 + the signal that ended it.
  int wait();

 private:
  int output_ = -1;
  pid_t pid_ = -1;
  std::string pending_;
};

/// Codes of wait() above this one: a signal ended the child.
constexpr int kSignalCode = 128;

/// What such a code means: "the process was killed, as when memory runs out", and the program's own exit code for it:
/// kExitCapacity for SIGKILL, else kExitInternal.
std::string signal_text(int code);
int signal_exit_code(int code);

/// Ends all children, at once with SIGTERM and after two seconds with SIGKILL, and lets none be started from then on.
/// For the thread that ends the program; the main thread may be anywhere.
void stop_children();

/// While it lives, stop_children() waits. Once that has begun, the constructor never returns. For the main thread when
/// it writes files that the thread that ends the program removes: without it one could be written after the removal.
/// Not while a child is started or waited for.
class StopBarrier {
 public:
  StopBarrier();
  ~StopBarrier();
  StopBarrier(const StopBarrier&) = delete;
  StopBarrier& operator=(const StopBarrier&) = delete;
};

}  // namespace meniscus
