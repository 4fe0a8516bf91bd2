// SPDX-License-Identifier: BSD-3-Clause
// A child process: started without a shell, read line by line, and ended when this program ends; and the browser, which
// goes on.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace meniscus {

/// A child process. One thread makes and uses it and outlives it, since Linux ends a child when the *thread* that
/// started it ends; even kill -9 of this process leaves no child behind there.
class ChildProcess {
 public:
  /// arguments[0] is the program, looked for in the absolute folders of PATH unless it has a slash; it runs in
  /// `folder`, with an empty standard input and no signal blocked. Throws InputError if it cannot be started.
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& folder);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Returns the next line that the child writes, to standard output or error; nothing at their end. A line without end
  /// comes in pieces of 64 KiB.
  std::optional<std::string> next_line();

  /// True if the child wrote something, or ended, within this time.
  bool has_news(std::chrono::milliseconds patience) const;

  /// Sends SIGTERM to the child.
  void stop() const;

  /// Waits for the end of the child and returns its exit code, or 128 + the signal that ended it. Call it once.
  int wait();

 private:
  int output_ = -1;
  pid_t pid_ = -1;
  std::string pending_;
};

/// Runs a program that may outlive this one, such as a browser, and waits for its end. It has a session of its own,
/// where neither Ctrl-C nor the end of this program reaches it, and an empty standard input. Its output is discarded.
/// arguments: as for ChildProcess. Returns what ChildProcess::wait() returns, or kNotStarted.
int run_apart(const std::vector<std::string>& arguments);
constexpr int kNotStarted = 127;

/// If a code of wait() is above this one, a signal ended the child.
constexpr int kSignalCode = 128;

/// Returns the words for such a code, "the process that made it was killed, as when memory runs out", and this
/// program's own exit code for it: kExitCapacity for SIGKILL, else kExitInternal.
std::string signal_text(int code);
int signal_exit_code(int code);

/// Ends all children, at once with SIGTERM and after two seconds with SIGKILL, and lets none be started from then on.
/// The thread that ends the program calls it; the main thread may be anywhere.
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

/// Has the address opened by the program that BROWSER names, or else by the one that the desktop has for it, without a
/// shell. The browser goes on when this program ends. If none can be opened, `failed` is called with the reason, such
/// as "there is no display": on this thread or, later, on another one.
void open_in_browser(const std::string& address, std::function<void(const std::string& reason)> failed);

}  // namespace meniscus
