// SPDX-License-Identifier: BSD-3-Clause
// Implements system_process.h for Linux and macOS.
#include <atomic>
#include <csignal>
#include <cstring>
#include <thread>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/utsname.h>
#include <unistd.h>
#if defined(__GLIBC__)
#include <gnu/libc-version.h>
#endif
#if !defined(__APPLE__)
#include <sys/mman.h>
#include <sys/prctl.h>
#endif

#include "app/process/program_main.h"
#include "app/process/system_process.h"
#include "core/base/error.h"
#include "core/base/system_file.h"

namespace meniscus::system_process {

std::span<const char* const> words(int argc, char** argv) { return {argv, static_cast<std::size_t>(argc)}; }

void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // The lowest free number is taken, and lower ones are in use. Nothing can be done if even /dev/null is missing.
    [[maybe_unused]] const int taken = ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

bool is_terminal(std::FILE* stream) { return ::isatty(::fileno(stream)) == 1; }

void write_error(std::string_view line) noexcept {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
}

void end(int code) noexcept { ::_exit(code); }

bool memory_is_limited() {
  rlimit limit{};
  return ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

std::uint64_t physical_memory() {
  return static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

#if defined(__ELF__)
namespace {

constexpr unsigned kSecondsToLoad = 60;

/// Ends the program with an error. A signal handler may make all its calls.
[[noreturn]] void give_up() {
  write_error(
      "meniscus: error: not enough memory under the limit on address space; raise it (ulimit -v), or use fewer "
      "--threads\n");
  end(kExitCapacity);
}

void handle(int) { give_up(); }

void watch() {
  if (!memory_is_limited()) return;
  static std::array<char, 1 << 16> stack;  // the usual stack may be the one that could not grow
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
#else
void libraries_are_loaded() {}
#endif

namespace {

std::atomic<int> first_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);
std::array<int, 2> signal_pipe{-1, -1};  // macOS has no unnamed semaphores, so this is a pipe

/// Notes a signal. A signal handler may make all its calls.
void note_signal(int signal) {
  const int before = errno;
  int none = 0;
  if (first_signal.compare_exchange_strong(none, signal)) {
    [[maybe_unused]] const ssize_t written = ::write(signal_pipe[1], "", 1);
  }
  errno = before;
}

}  // namespace

// Our threads, except one, block the signals, so that their calls are not interrupted. That alone is not enough:
// libraries such as OpenBLAS start threads before main begins, and a signal to one of these would end the program at
// once.
void await_stop(void (*stopped)(int signal)) {
  std::signal(SIGXFSZ, SIG_IGN);
  if (!make_pipe(signal_pipe))
    throw CapacityError(std::string("the system cannot make a pipe for signals: ") + std::strerror(errno));
  struct sigaction action {};
  action.sa_handler = note_signal;
  action.sa_flags = SA_RESTART;
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) {
    ::sigaction(signal, &action, nullptr);
    sigaddset(&signals, signal);
  }
  std::thread([stopped] {
    for (char byte = 0; ::read(signal_pipe[0], &byte, 1) != 1;) {
    }
    stopped(first_signal);
  }).detach();
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

void outlive_readers() { std::signal(SIGPIPE, SIG_IGN); }

ProcessorTime processor_time() {
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return {seconds(used.ru_utime), seconds(used.ru_stime)};
}

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

std::string system_name() {
  utsname system{};
  ::uname(&system);
  std::string name = std::string(system.sysname) + " " + system.release + " " + system.machine;
#if defined(__GLIBC__)
  name += std::string(", glibc ") + ::gnu_get_libc_version();
#endif
  return name;
}

void set_variable(const char* name, const std::string& value) { ::setenv(name, value.c_str(), 0); }

void keep_from_children(std::intptr_t connection) { ::fcntl(static_cast<int>(connection), F_SETFD, FD_CLOEXEC); }

#if defined(__APPLE__)
namespace {

constexpr int kNoSignal = 0;
bool is_closed_in_children(int file) { return ::fcntl(file, F_SETFD, FD_CLOEXEC) == 0; }

}  // namespace

bool make_pipe(std::array<int, 2>& ends) {
  return ::pipe(ends.data()) == 0 && is_closed_in_children(ends[0]) && is_closed_in_children(ends[1]);
}

bool make_connection(std::array<int, 2>& ends) {
  const int on = 1;
  return ::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) == 0 && is_closed_in_children(ends[0]) &&
         is_closed_in_children(ends[1]) && ::setsockopt(ends[0], SOL_SOCKET, SO_NOSIGPIPE, &on, sizeof on) == 0;
}

int make_nameless_file() {
  char name[] = "/tmp/meniscus-XXXXXX";
  const int file = ::mkostemp(name, O_CLOEXEC);
  if (file >= 0) ::unlink(name);
  return file;
}

void end_with_parent() noexcept {}
#else
namespace {

constexpr int kNoSignal = MSG_NOSIGNAL;

}  // namespace

bool make_pipe(std::array<int, 2>& ends) { return ::pipe2(ends.data(), O_CLOEXEC) == 0; }

bool make_connection(std::array<int, 2>& ends) {
  return ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0;
}

int make_nameless_file() { return ::memfd_create("meniscus", MFD_CLOEXEC); }

void end_with_parent() noexcept { ::prctl(PR_SET_PDEATHSIG, SIGKILL); }
#endif

std::ptrdiff_t send(int end, std::span<const std::uint8_t> bytes) {
  return uninterrupted([&] { return ::send(end, bytes.data(), bytes.size(), kNoSignal); });
}

}  // namespace meniscus::system_process
