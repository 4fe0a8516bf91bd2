// SPDX-License-Identifier: BSD-3-Clause
// Handlers installed by the executable before the initialisers of its libraries run.
#include "app/process/memory_limit.h"

#include <array>
#include <csignal>
#include <exception>
#include <string_view>

#include <sys/resource.h>
#include <unistd.h>

#include "app/process/program_error.h"

namespace meniscus {
namespace {

constexpr unsigned kSecondsToLoad = 60;

/// Nothing but what a signal handler may do.
[[noreturn]] void give_up() {
  constexpr std::string_view kLine =
      "meniscus: error: not enough memory under the limit on address space; raise it (ulimit -v), or use fewer "
      "--threads\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kLine.data(), kLine.size());
  ::_exit(kExitCapacity);
}

void handle(int) { give_up(); }

void watch() {
  if (!memory_is_limited()) return;
  static std::array<char, 1 << 16> stack;  // the other one may be what could not grow
  stack_t alternative{};
  alternative.ss_sp = stack.data();
  alternative.ss_size = stack.size();
  ::sigaltstack(&alternative, nullptr);
  struct sigaction action {};
  action.sa_handler = handle;
  action.sa_flags = SA_ONSTACK;
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGALRM}) ::sigaction(signal, &action, nullptr);
  std::set_terminate(give_up);
  ::alarm(kSecondsToLoad);
}

__attribute__((section(".preinit_array"), used)) void (*const watch_from_the_beginning)() = watch;

}  // namespace

void libraries_are_loaded() { ::alarm(0); }

bool memory_is_limited() {
  rlimit limit{};
  return ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

}  // namespace meniscus
