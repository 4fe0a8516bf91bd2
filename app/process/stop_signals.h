// SPDX-License-Identifier: BSD-3-Clause
// Handles requests to stop: Ctrl-C, a queue's signal, the end of the terminal.
#pragma once

#include <functional>
#include <mutex>
#include <optional>

namespace meniscus {

/// From this call on, SIGINT, SIGTERM, SIGHUP and SIGUSR1 remove unfinished files before the program ends, as the
/// signal would have ended it. SIGXFSZ is ignored, so that a file too large is an OutputError. Call it once, before
/// other threads are started.
void clean_up_on_signals();

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

}  // namespace meniscus
