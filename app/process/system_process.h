// SPDX-License-Identifier: BSD-3-Clause
// The process as the operating system has it: system_process_posix.cpp (Linux, macOS) and system_process_windows.cpp
// implement it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace meniscus::system_process {

/// The words that main() got, that of the program first, in UTF-8. They live as long as the program.
std::span<const char* const> words(int argc, char** argv);

/// A standard stream that is closed gets a descriptor that nothing can be read from or written to, lest the next file
/// opened takes its number and messages are written into it. What is printed has the same bytes on every system.
void hold_standard_streams();
/// Writes a line of ours on standard error. Needs no memory, so that a signal handler may call it.
void say(std::string_view line) noexcept;
/// Ends the program without its destructors. A signal handler may call it, too.
[[noreturn]] void end(int code) noexcept;

/// Under a limit of memory that libraries do not survive: memory.h says what happens, from when on, and until when.
bool memory_is_limited();
void libraries_are_loaded();
/// The memory of the machine, in bytes.
std::uint64_t physical_memory();

/// Calls `stopped` on a thread of its own when the first of SIGINT, SIGTERM, SIGHUP and SIGUSR1 comes, or what is like
/// one of them on Windows, with its number; and has a file that gets too large be an error of write(). Call once,
/// before other threads are started. Throws CapacityError.
void await_stop(void (*stopped)(int signal));

/// Seconds of processors since the program began.
struct ProcessorTime {
  double user = 0, system = 0;
};
ProcessorTime processor_time();

/// The name of this machine; empty where it has none.
std::string host();

// What connects a child process, on Linux and macOS only. No other child inherits these; where one fails, `errno` says
// why.

/// The reading and the writing end.
bool make_pipe(std::array<int, 2>& ends);
/// An end for this process and one for a child. To send() to a child that is gone is an error and no signal.
bool make_connection(std::array<int, 2>& ends);
std::ptrdiff_t send(int end, std::span<const std::uint8_t> bytes);
/// A file that has no name, to write and read; -1 if that fails.
int make_nameless_file();
/// In a child: has the system kill it when the thread that started it ends. macOS does not know that.
void end_with_parent() noexcept;

}  // namespace meniscus::system_process
