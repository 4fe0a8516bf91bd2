// SPDX-License-Identifier: BSD-3-Clause
// A thread waits until a handler, which may run on any other, tells it of a signal.
#include "app/process/stop_signals.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <pthread.h>
#include <semaphore.h>
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

std::atomic<int> first_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);
sem_t told;

/// Nothing but what a signal handler may do.
void tell(int signal) {
  int none = 0;
  if (first_signal.compare_exchange_strong(none, signal)) ::sem_post(&told);
}

}  // namespace

// All threads of ours but one block the signals, so that nothing of theirs is interrupted. That alone would not do:
// libraries such as OpenBLAS start threads before main begins, and one of these would end the program at once.
void clean_up_on_signals() {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is then an error of write(), and reported
  ::sem_init(&told, 0, 0);
  struct sigaction action {};
  action.sa_handler = tell;
  action.sa_flags = SA_RESTART;
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) {
    ::sigaction(signal, &action, nullptr);
    sigaddset(&signals, signal);
  }
  std::thread([] {
    while (::sem_wait(&told) != 0 && errno == EINTR) {
    }
    const std::lock_guard lock(handling().mutex);
    if (handling().stop) handling().stop();
    remove_unfinished_outputs();
    ::_exit(handling().exit_code.value_or(128 + first_signal));
  }).detach();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
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
