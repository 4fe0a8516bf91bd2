// SPDX-License-Identifier: BSD-3-Clause
// Implements child_process.h for Windows. A job object holds all children, and ends them with this program.
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <shellapi.h>

#include "app/process/child_process.h"
#include "app/process/system_process.h"
#include "core/base/system_file.h"

namespace meniscus {
namespace {

constexpr UINT kCodeOfStop = kSignalCode + 15, kCodeOfKill = kSignalCode + 9;  // the codes for SIGTERM and SIGKILL

/// Returns the mutex that is held while a child is started, while files are written, and when the program ends.
std::mutex& starting() {
  static std::mutex instance;
  return instance;
}

HANDLE job() {
  static const HANDLE instance = [] {
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
    const HANDLE made = ::CreateJobObjectW(nullptr, nullptr);
    ::SetInformationJobObject(made, JobObjectExtendedLimitInformation, &limits, sizeof limits);
    return made;
  }();
  return instance;
}

/// Returns a word as CommandLineToArgvW() reads it: backslashes before a quotation mark are doubled.
std::wstring quoted(const std::wstring& word) {
  std::wstring text = L"\"";
  std::size_t slashes = 0;
  for (const wchar_t letter : word) {
    if (letter == L'"') text.append(slashes + 1, L'\\');
    slashes = letter == L'\\' ? slashes + 1 : 0;
    text += letter;
  }
  return text.append(slashes, L'\\') + L'"';
}

/// Starts a program with these descriptors as its standard streams, and returns its handle. Throws Error.
std::intptr_t start(const std::vector<std::string>& words, const std::filesystem::path& folder,
                    const std::array<int, 3>& streams) {
  std::wstring line;
  for (const std::string& word : words) line += quoted(path_of_text(word).native()) + L' ';
  std::array<HANDLE, 3> handles{};
  for (std::size_t n = 0; n < handles.size(); ++n) handles[n] = reinterpret_cast<HANDLE>(::_get_osfhandle(streams[n]));
  STARTUPINFOW streams_of_child{};
  streams_of_child.cb = sizeof streams_of_child;
  streams_of_child.dwFlags = STARTF_USESTDHANDLES;
  streams_of_child.hStdInput = handles[0];
  streams_of_child.hStdOutput = handles[1];
  streams_of_child.hStdError = handles[2];
  PROCESS_INFORMATION child{};
  const std::lock_guard lock(starting());
  for (const HANDLE handle : handles) ::SetHandleInformation(handle, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
  const bool is_started = ::CreateProcessW(nullptr, line.data(), nullptr, nullptr, TRUE, CREATE_SUSPENDED, nullptr,
                                           folder.empty() ? nullptr : folder.c_str(), &streams_of_child, &child);
  const auto error = static_cast<int>(::GetLastError());
  for (const HANDLE handle : handles) ::SetHandleInformation(handle, HANDLE_FLAG_INHERIT, 0);
  if (!is_started) {
    const std::string why = std::system_category().message(error);
    throw Error("cannot be started: {}", why.substr(0, why.find_last_not_of(". \r\n") + 1));
  }
  ::AssignProcessToJobObject(job(), child.hProcess);
  ::ResumeThread(child.hThread);
  ::CloseHandle(child.hThread);
  return reinterpret_cast<std::intptr_t>(child.hProcess);
}

HANDLE handle_of(std::intptr_t process) { return reinterpret_cast<HANDLE>(process); }

/// Waits for the end of a process, and returns its exit code.
int code_of_ended(std::intptr_t process) {
  DWORD code = 0;
  ::WaitForSingleObject(handle_of(process), INFINITE);
  ::GetExitCodeProcess(handle_of(process), &code);
  return static_cast<int>(code);
}

/// A descriptor that is closed at the end of its scope.
struct Descriptor {
  ~Descriptor() { ::_close(number); }
  int number;
};

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
  std::array<int, 2> ends{-1, -1};
  if (!system_process::make_pipe(ends)) throw CapacityError("no pipe to a child: {}", std::strerror(errno));
  output_ = ends[0];
  const Descriptor writing{ends[1]}, nothing{system_file::open_to_read("NUL")};
  try {
    pid_ = start(arguments, folder, {nothing.number, writing.number, writing.number});
  } catch (const Error& error) {
    ::_close(output_);
    throw InputError(arguments[0], 0, "{}; is it installed, and in PATH?", error.what());
  }
}

ChildProcess::~ChildProcess() {
  if (pid_ != -1) {
    ::TerminateProcess(handle_of(pid_), kCodeOfKill);
    wait();
  }
  ::_close(output_);
}

bool ChildProcess::has_news(std::chrono::milliseconds patience) const {
  const auto reading = reinterpret_cast<HANDLE>(::_get_osfhandle(output_));
  const auto until = std::chrono::steady_clock::now() + patience;
  DWORD waiting = 0;
  while (pending_.find('\n') == std::string::npos && ::PeekNamedPipe(reading, nullptr, 0, nullptr, &waiting, nullptr) &&
         waiting == 0) {
    if (std::chrono::steady_clock::now() >= until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

void ChildProcess::stop() const { ::TerminateProcess(handle_of(pid_), kCodeOfStop); }

int ChildProcess::wait() {
  const int code = code_of_ended(pid_);
  ::CloseHandle(handle_of(std::exchange(pid_, -1)));
  const std::lock_guard lock(starting());  // this lock is never free again once the program is about to end
  return code;
}

FedProcess::FedProcess(std::vector<std::string> words) {
  std::array<int, 2> ends{-1, -1};
  if (!system_process::make_connection(ends)) throw Error("cannot be started: {}", std::strerror(errno));
  input_ = ends[0];
  complaints_ = system_process::make_nameless_file();
  const Descriptor reading{ends[1]}, nothing{::_wopen(L"NUL", _O_WRONLY | _O_NOINHERIT)};
  try {
    const auto held = hold_stops();
    pid_ = start(words, {}, {reading.number, nothing.number, complaints_});
  } catch (const Error&) {
    ::_close(input_);
    ::_close(complaints_);
    throw;
  }
}

FedProcess::~FedProcess() {
  kill();
  finish();
  ::_close(complaints_);
}

int FedProcess::finish() {
  if (input_ >= 0) ::_close(std::exchange(input_, -1));
  if (pid_ == -1) return code_;
  code_ = code_of_ended(pid_);
  const auto held = hold_stops();
  ::CloseHandle(handle_of(std::exchange(pid_, -1)));
  return code_;
}

void FedProcess::kill() const {
  if (pid_ == -1) return;
  ::TerminateProcess(handle_of(pid_), kCodeOfKill);
  code_of_ended(pid_);
}

std::uint64_t memory_of_largest_child() {
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION used{};
  ::QueryInformationJobObject(job(), JobObjectExtendedLimitInformation, &used, sizeof used, nullptr);
  return used.PeakProcessMemoryUsed;
}

void stop_children() {
  static std::atomic<bool> is_begun = false;
  if (is_begun.exchange(true)) return;
  starting().lock();
  ::TerminateJobObject(job(), kCodeOfStop);
}

StopBarrier::StopBarrier() { starting().lock(); }
StopBarrier::~StopBarrier() { starting().unlock(); }

void open_in_browser(const std::string& address, std::function<void(const std::string& reason)> failed) {
  constexpr std::intptr_t kLastError = 32;
  const HINSTANCE answer = ::ShellExecuteA(nullptr, "open", address.c_str(), nullptr, nullptr, SW_SHOWNORMAL);
  if (reinterpret_cast<std::intptr_t>(answer) <= kLastError) failed("the system knows no browser");
}

}  // namespace meniscus
