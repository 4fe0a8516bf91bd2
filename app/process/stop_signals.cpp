// SPDX-License-Identifier: BSD-3-Clause
// Runs the thread that waits for a stop, and calls what was registered.
#include "app/process/stop_signals.h"

#include <optional>
#include <utility>
#include <vector>

#include "app/process/system_process.h"
#include "core/base/output_file.h"

namespace meniscus {
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

}  // namespace

void clean_up_on_signals() { system_process::await_stop(stop); }

std::unique_lock<std::mutex> hold_stops() { return std::unique_lock(handling().mutex); }

StopHandler::StopHandler(std::function<void()> stop, std::optional<int> exit_code) {
  const auto held = hold_stops();
  handling().all.push_back({this, std::move(stop), exit_code});
}

StopHandler::~StopHandler() {
  const auto held = hold_stops();
  std::erase_if(handling().all, [this](const Registered& one) { return one.handler == this; });
}

}  // namespace meniscus
