// SPDX-License-Identifier: BSD-3-Clause
// Runs the thread that waits for a stop, and calls what was registered.
#include "app/process/stop_signals.h"

#include <mutex>
#include <optional>
#include <utility>

#include "app/process/system_process.h"
#include "core/base/output_file.h"

namespace meniscus {
namespace {

struct Handling {
  std::mutex mutex;  // held from the signal to the end of the program, so that a handler outlives its call
  std::function<void()> stop;
  std::optional<int> exit_code;
};

Handling& handling() {
  static Handling instance;
  return instance;
}

void stop(int signal) {
  const std::lock_guard lock(handling().mutex);
  if (handling().stop) handling().stop();
  remove_unfinished_outputs();
  system_process::end(handling().exit_code.value_or(128 + signal));
}

}  // namespace

void clean_up_on_signals() { system_process::await_stop(stop); }

StopHandler::StopHandler(std::function<void()> stop, std::optional<int> exit_code) {
  const std::lock_guard lock(handling().mutex);
  handling().stop = std::move(stop);
  handling().exit_code = exit_code;
}

StopHandler::~StopHandler() {
  const std::lock_guard lock(handling().mutex);
  handling().stop = nullptr;
  handling().exit_code.reset();
}

}  // namespace meniscus
