// SPDX-License-Identifier: BSD-3-Clause
// Implements child_process.h for Linux and macOS: handles signals, descriptors and orphans.
#include "app/process/child_process.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "app/process/system_process.h"
#include "core/base/system_file.h"

extern char** environ;

namespace meniscus {
namespace {

/// The processes that were started and not yet waited for.
struct Registry {
  std::mutex mutex;
  std::vector<pid_t> running;
  bool closed = false;
};

Registry& registry() {
  static Registry instance;
  return instance;
}

/// Never returns once the program is about to end: a child that was stopped has not failed, and its result does not
/// count. The caller holds the lock.
void stay_if_stopping() {
  while (registry().closed) std::this_thread::sleep_for(std::chrono::hours(1));
}

/// Runs between fork and exec. All its calls are safe there, where other threads may hold any lock.
[[noreturn]] void become(const char* program, char* const* argv, char* const* environment, const char* folder,
                         int output, int report, pid_t parent) {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  std::signal(SIGXFSZ, SIG_DFL);  // other programs may not check for a write beyond the limit
  system_process::end_with_parent();
  const int nothing = ::open("/dev/null", O_RDONLY);
  // The parent may have died before the request above.
  if (::getppid() == parent && nothing >= 0 && ::dup2(nothing, STDIN_FILENO) >= 0 &&
      ::dup2(output, STDOUT_FILENO) >= 0 && ::dup2(output, STDERR_FILENO) >= 0 && ::chdir(folder) == 0)
    ::execve(program, argv, environment);
  const int error = errno;
  [[maybe_unused]] const ssize_t written = ::write(report, &error, sizeof error);
  ::_exit(127);
}

/// Returns the program's path. Only absolute folders of PATH count: any user may have made the child's folder.
std::string program_path(const std::string& name) {
  if (name.find('/') != std::string::npos) return name;
  const char* const path = std::getenv("PATH");
  for (std::string_view rest = path ? path : ""; !rest.empty();) {
    const std::string_view folder = rest.substr(0, rest.find(':'));
    rest.remove_prefix(std::min(rest.size(), folder.size() + 1));
    const std::string candidate = fmt::format("{}/{}", folder, name);
    if (folder.starts_with('/') && ::access(candidate.c_str(), X_OK) == 0) return candidate;
  }
  return fmt::format("/{}", name);  // starting it reports that it does not exist
}

/// Returns the words as pointers for an exec function, which does not change them.
std::vector<char*> pointers_to(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  return argv;
}

/// Waits until the process has ended. Its number is not yet free for another process.
void await_end(pid_t process) {
  siginfo_t ended{};
  uninterrupted([&] { return ::waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOWAIT); });
}

int exit_code(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalCode + WTERMSIG(status); }

struct Pipe {
  Pipe() {
    if (!system_process::make_pipe(ends)) throw CapacityError("no pipe to a child: {}", std::strerror(errno));
  }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) ::close(end);
  }
  void close_writing() { ::close(std::exchange(ends[1], -1)); }
  std::array<int, 2> ends{-1, -1};
};

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
  const std::vector<char*> argv = pointers_to(arguments);
  // Some programs, such as Blender, take their folder from PWD rather than from the system.
  std::string working_folder = "PWD=" + std::filesystem::absolute(folder).lexically_normal().string();
  std::vector<char*> environment{working_folder.data()};
  for (char** variable = environ; *variable; ++variable)
    if (!std::string_view(*variable).starts_with("PWD=")) environment.push_back(*variable);
  environment.push_back(nullptr);
  const std::string program = program_path(arguments[0]);
  Pipe output, report;
  {
    // A stop waits until the child is registered, so that no child escapes it; no child is started afterwards.
    const std::lock_guard lock(registry().mutex);
    stay_if_stopping();
    registry().running.reserve(registry().running.size() +
                               1);  // nothing may fail between the start and its registration
    const pid_t parent = ::getpid();
    pid_ = ::fork();
    if (pid_ == 0)
      become(program.c_str(), argv.data(), environment.data(), folder.c_str(), output.ends[1], report.ends[1], parent);
    if (pid_ < 0) throw CapacityError("{} cannot be started: {}", arguments[0], std::strerror(errno));
    registry().running.push_back(static_cast<pid_t>(pid_));
  }
  output.close_writing();
  report.close_writing();
  int error = 0;
  if (::read(report.ends[0], &error, sizeof error) == sizeof error) {
    wait();
    throw InputError(arguments[0], 0, "cannot be started: {}; is it installed, and in PATH?", std::strerror(error));
  }
  output_ = std::exchange(output.ends[0], -1);
}

ChildProcess::~ChildProcess() {
  if (pid_ > 0) {
    ::kill(static_cast<pid_t>(pid_), SIGKILL);
    wait();
  }
  if (output_ >= 0) ::close(output_);
}

bool ChildProcess::has_news(std::chrono::milliseconds patience) const {
  if (pending_.find('\n') != std::string::npos) return true;
  pollfd reading{output_, POLLIN, 0};
  return ::poll(&reading, 1, static_cast<int>(patience.count())) > 0;
}

void ChildProcess::stop() const {
  if (pid_ > 0) ::kill(static_cast<pid_t>(pid_), SIGTERM);
}

int ChildProcess::wait() {
  await_end(static_cast<pid_t>(pid_));
  int status = 0;
  {
    // Its number becomes free under the lock, so that a stop cannot kill another process that gets the number.
    const std::lock_guard lock(registry().mutex);
    ::waitpid(static_cast<pid_t>(pid_), &status, 0);
    std::erase(registry().running, std::exchange(pid_, -1));
    stay_if_stopping();
  }
  return exit_code(status);
}

FedProcess::FedProcess(std::vector<std::string> words) {
  std::array<int, 2> ends{-1, -1};
  if (!system_process::make_connection(ends)) throw Error("cannot be started: {}", std::strerror(errno));
  complaints_ = system_process::make_nameless_file();
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_adddup2(&files, ends[1], STDIN_FILENO);
  ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_adddup2(&files, complaints_, STDERR_FILENO);
  int error = 0;
  {
    const auto held = hold_stops();
    pid_t pid = -1;
    error = ::posix_spawnp(&pid, words[0].c_str(), &files, nullptr, pointers_to(words).data(), environ);
    if (error == 0) pid_ = pid;
  }
  ::posix_spawn_file_actions_destroy(&files);
  ::close(ends[1]);
  input_ = ends[0];
  if (error == 0) return;
  ::close(input_);
  ::close(complaints_);
  throw Error("cannot be started: {}", std::strerror(error));
}

FedProcess::~FedProcess() {
  kill();
  finish();
  ::close(complaints_);
}

int FedProcess::finish() {
  if (input_ >= 0) ::close(std::exchange(input_, -1));
  if (pid_ < 0) return code_;
  await_end(static_cast<pid_t>(pid_));
  // Its number becomes free under the lock, so that a stop cannot kill another process that gets the number.
  const auto held = hold_stops();
  int status = 0;
  ::waitpid(static_cast<pid_t>(pid_), &status, 0);
  pid_ = -1;
  return code_ = exit_code(status);
}

void FedProcess::kill() const {
  if (pid_ < 0) return;
  ::kill(static_cast<pid_t>(pid_), SIGKILL);
  await_end(static_cast<pid_t>(pid_));
}

std::uint64_t memory_of_largest_child() {
#if defined(__APPLE__)
  constexpr std::uint64_t kUnit = 1;
#else
  constexpr std::uint64_t kUnit = 1024;
#endif
  rusage children{};
  ::getrusage(RUSAGE_CHILDREN, &children);
  return static_cast<std::uint64_t>(children.ru_maxrss) * kUnit;
}

int run_apart(const std::vector<std::string>& arguments) {
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  sigset_t none, changed;  // the signals that the child blocks, and those that this program ignores
  sigemptyset(&none);
  sigemptyset(&changed);
  sigaddset(&changed, SIGPIPE);
  sigaddset(&changed, SIGXFSZ);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setsigdefault(&attributes, &changed);
  pid_t pid = -1;
  const int error = ::posix_spawn(&pid, program_path(arguments[0]).c_str(), &files, &attributes,
                                  pointers_to(arguments).data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&files);
  int status = 0;
  while (error == 0 && ::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return error == 0 ? exit_code(status) : kNotStarted;
}

void stop_children() {
  // A second call would wait for the lock, which the thread that waits for a child may hold until the program ends.
  static std::atomic<bool> is_begun = false;
  if (is_begun.exchange(true)) return;
  std::vector<pid_t> children;
  {
    const std::lock_guard lock(registry().mutex);
    registry().closed = true;
    for (const pid_t child : registry().running) ::kill(child, SIGTERM);
    children = registry().running;
  }
  const auto alive = [](pid_t child) {
    siginfo_t ended{};
    return ::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == 0;
  };
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  for (const pid_t child : children) {
    while (alive(child) && std::chrono::steady_clock::now() < deadline)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (alive(child)) ::kill(child, SIGKILL);
  }
}

StopBarrier::StopBarrier() {
  registry().mutex.lock();
  stay_if_stopping();
}

StopBarrier::~StopBarrier() { registry().mutex.unlock(); }

namespace {

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

#if defined(__APPLE__)
constexpr const char* kOpener = "open";
bool has_display() { return true; }
#else
constexpr const char* kOpener = "xdg-open";
bool has_display() { return !variable("DISPLAY").empty() || !variable("WAYLAND_DISPLAY").empty(); }
#endif

}  // namespace

void open_in_browser(const std::string& address, std::function<void(const std::string& reason)> failed) {
  // Remote editors name a program that needs no display. Lists, and names with arguments, are for xdg-open.
  std::string opener = variable("BROWSER");
  if (opener.empty() || opener.find_first_of(" :%") != std::string::npos) {
    if (!has_display()) return failed("there is no display");
    opener = kOpener;
  }
  std::thread([opener, address, failed = std::move(failed)] {
    const int code = run_apart({opener, address});
    if (code == kNotStarted) return failed(opener + " cannot be started");
    if (code != 0) failed(fmt::format("{} ended with code {}", opener, code));
  }).detach();
}

}  // namespace meniscus
