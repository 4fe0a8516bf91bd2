// SPDX-License-Identifier: BSD-3-Clause
// Implements system_process.h for Windows.
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#include <windows.h>

#include <shellapi.h>

#include "app/process/system_process.h"
#include "core/base/error.h"
#include "core/base/system_file.h"

namespace meniscus::system_process {
namespace {

std::string in_utf8(const wchar_t* text) {
  const int size = ::WideCharToMultiByte(CP_UTF8, 0, text, -1, nullptr, 0, nullptr, nullptr);
  std::string bytes(size > 0 ? static_cast<std::size_t>(size) : 1, '\0');
  ::WideCharToMultiByte(CP_UTF8, 0, text, -1, bytes.data(), size, nullptr, nullptr);
  bytes.pop_back();  // removes the final zero
  return bytes;
}

/// Returns the words of the command line as they were typed. The arguments of main() are in the machine's code page,
/// and the C library has replaced arguments with wildcards by names of files.
std::vector<std::string> given_words() {
  int count = 0;
  const std::unique_ptr<wchar_t*, decltype(&::LocalFree)> wide(::CommandLineToArgvW(::GetCommandLineW(), &count),
                                                               ::LocalFree);
  std::vector<std::string> words;
  for (int n = 0; wide && n < count; ++n) words.push_back(in_utf8(wide.get()[n]));
  return words;
}

}  // namespace

std::span<const char* const> words(int, char**) {
  static const std::vector<std::string> texts = given_words();
  static const std::vector<const char*> pointers = [] {
    std::vector<const char*> all;
    for (const std::string& text : texts) all.push_back(text.c_str());
    return all;
  }();
  return pointers;
}

// A closed stream keeps its number on Windows. Texts are UTF-8 everywhere, and lines end as on other systems.
void hold_standard_streams() {
  ::SetConsoleOutputCP(CP_UTF8);
  for (std::FILE* stream : {stdout, stderr}) ::_setmode(::_fileno(stream), _O_BINARY);
}

bool is_terminal(std::FILE* stream) {
  DWORD mode = 0;
  const auto terminal = reinterpret_cast<HANDLE>(::_get_osfhandle(::_fileno(stream)));
  // Terminals show the characters of a progress bar only in this mode.
  return ::GetConsoleMode(terminal, &mode) && ::SetConsoleMode(terminal, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
}

void write_error(std::string_view line) noexcept {
  DWORD written = 0;
  ::WriteFile(::GetStdHandle(STD_ERROR_HANDLE), line.data(), static_cast<DWORD>(line.size()), &written, nullptr);
}

void end(int code) noexcept { ::_exit(code); }

// Windows has no limit on address space.
bool memory_is_limited() { return false; }
void libraries_are_loaded() {}

std::uint64_t physical_memory() {
  MEMORYSTATUSEX status{};
  status.dwLength = sizeof status;
  return ::GlobalMemoryStatusEx(&status) ? status.ullTotalPhys : UINT64_MAX;
}

namespace {

void (*when_stopped)(int signal) = nullptr;
std::atomic_flag is_stopped;

/// Handles an event; the system calls it on a separate thread.
BOOL WINAPI take_event(DWORD event) {
  constexpr int kHangUp = 1;  // SIGHUP on other systems
  const int signal = event == CTRL_C_EVENT ? SIGINT : event == CTRL_BREAK_EVENT ? SIGTERM : kHangUp;
  if (!is_stopped.test_and_set()) when_stopped(signal);
  return TRUE;
}

}  // namespace

void await_stop(void (*stopped)(int signal)) {
  when_stopped = stopped;
  if (!::SetConsoleCtrlHandler(take_event, TRUE))
    throw CapacityError("the system cannot report Ctrl-C: error " + std::to_string(::GetLastError()));
}

void outlive_readers() {}  // Windows has no such signal

ProcessorTime processor_time() {
  const auto seconds = [](const FILETIME& time) {
    constexpr double kPerSecond = 1e7;
    return static_cast<double>(std::uint64_t{time.dwHighDateTime} << 32 | time.dwLowDateTime) / kPerSecond;
  };
  FILETIME begun{}, ended{}, system{}, user{};
  ::GetProcessTimes(::GetCurrentProcess(), &begun, &ended, &system, &user);
  return {seconds(user), seconds(system)};
}

std::string host() {
  std::array<wchar_t, MAX_COMPUTERNAME_LENGTH + 1> name{};
  auto size = static_cast<DWORD>(name.size());
  return ::GetComputerNameW(name.data(), &size) ? in_utf8(name.data()) : "";
}

std::string system_name() {
  OSVERSIONINFOW version{};
  version.dwOSVersionInfoSize = sizeof version;
  // GetVersionEx() reports an older version to programs.
  using Ask = LONG(WINAPI*)(OSVERSIONINFOW*);
  const auto address = reinterpret_cast<void*>(::GetProcAddress(::GetModuleHandleW(L"ntdll"), "RtlGetVersion"));
  if (address) reinterpret_cast<Ask>(address)(&version);
  return "Windows " + std::to_string(version.dwMajorVersion) + "." + std::to_string(version.dwMinorVersion) + "." +
         std::to_string(version.dwBuildNumber);
}

void set_variable(const char* name, const std::string& value) {
  if (!std::getenv(name)) ::_putenv_s(name, value.c_str());
}

bool make_pipe(std::array<int, 2>& ends) {
  constexpr unsigned kSize = 1 << 16;
  return ::_pipe(ends.data(), kSize, _O_BINARY | _O_NOINHERIT) == 0;
}

// Makes a pipe: on Windows a write without a reader is an error, not a signal.
bool make_connection(std::array<int, 2>& ends) {
  if (!make_pipe(ends)) return false;
  std::swap(ends[0], ends[1]);
  return true;
}

std::ptrdiff_t send(int end, std::span<const std::uint8_t> bytes) {
  const auto parts = std::as_bytes(bytes);
  return system_file::write(end, parts.data(), parts.size());
}

int make_nameless_file() {
  std::array<wchar_t, MAX_PATH + 1> folder{}, name{};
  ::GetTempPathW(static_cast<DWORD>(folder.size()), folder.data());
  ::GetTempFileNameW(folder.data(), L"men", 0, name.data());
  return ::_wopen(name.data(), _O_RDWR | _O_CREAT | _O_BINARY | _O_NOINHERIT | _O_TEMPORARY, _S_IREAD | _S_IWRITE);
}

void keep_from_children(std::intptr_t connection) {
  ::SetHandleInformation(reinterpret_cast<HANDLE>(connection), HANDLE_FLAG_INHERIT, 0);
}

}  // namespace meniscus::system_process
