// SPDX-License-Identifier: BSD-3-Clause
// Handles requests to stop: Ctrl-C, a queue's signal, the end of the terminal.
#pragma once

#include <functional>
#include <mutex>
#include <optional>

namespace meniscus {

/// From now on SIGINT, SIGTERM, SIGHUP and SIGUSR1 remove unfinished files before the program ends, as the signal would
/// have ended it; SIGXFSZ is ignored, so that a file too large is an OutputError. Call once, before other threads are
/// started.
void clean_up_on_signals();

/// While this lives, these signals call `stop` first, on a thread of its own, and the program ends with `exit_code`,
/// if there is one. Of several the youngest is called first, and the youngest exit code counts.
class StopHandler {
 public:
  StopHandler(std::function<void()> stop, std::optional<int> exit_code);
  ~StopHandler();
  StopHandler(const StopHandler&) = delete;
  StopHandler& operator=(const StopHandler&) = delete;
};

/// While the lock is held no handler is called, so that what a handler looks at changes as a whole. From a signal on it
/// is never given again.
std::unique_lock<std::mutex> hold_stops();

}  // namespace meniscus
