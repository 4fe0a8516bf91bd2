// SPDX-License-Identifier: BSD-3-Clause
// One thread waits for the signals that all others block.
#include "app/stop_signals.h"

#include <csignal>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <pthread.h>
#include <unistd.h>

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

}  // namespace

void clean_up_on_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals] {
    int signal = 0;
    while (sigwait(&signals, &signal) != 0) {
    }
    const std::lock_guard lock(handling().mutex);
    if (handling().stop) handling().stop();
    remove_unfinished_outputs();
    ::_exit(handling().exit_code.value_or(128 + signal));
  }).detach();
}

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
