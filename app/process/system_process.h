// SPDX-License-Identifier: BSD-3-Clause
// Functions of the operating system for this process: system_process_posix.cpp (Linux, macOS) and
// system_process_windows.cpp implement it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>

namespace meniscus::system_process {

/// Returns the words that main() got, the program's first, in UTF-8. They live as long as the program.
std::span<const char* const> words(int argc, char** argv);

/// Gives a standard stream that is closed a descriptor that nothing can be read from or written to. Otherwise the next
/// file that is opened would take its number, and messages would be written into it. Printed text gets the same bytes
/// on every system.
void hold_standard_streams();
/// True if what is printed to this stream appears on a terminal.
bool is_terminal(std::FILE* stream);
/// Writes a line on standard error. It needs no memory, so that a signal handler may call it.
void write_error(std::string_view line) noexcept;
/// Ends the program without its destructors. A signal handler may call it, too.
[[noreturn]] void end(int code) noexcept;

/// Watch libraries under a limit of memory, which they do not survive, as memory.h describes it.
bool memory_is_limited();
void libraries_are_loaded();
/// Returns the memory of the machine, in bytes.
std::uint64_t physical_memory();

/// Calls `stopped` with the number of the first of SIGINT, SIGTERM, SIGHUP and SIGUSR1, or of a like event of Windows,
/// on a separate thread. Also makes a file that gets too large an error of write(). Call it once, before other threads
/// are started. Throws CapacityError.
void await_stop(void (*stopped)(int signal));

/// From this call on, a write to a pipe or a connection without a reader is an error, not a signal.
void outlive_readers();

/// The seconds of processors that the program has used.
struct ProcessorTime {
  double user = 0, system = 0;
};
ProcessorTime processor_time();

/// Returns the name of this machine; empty where it has none.
std::string host();
/// Returns the system, its version and its processor, such as "Linux 6.1.0 x86_64, glibc 2.36".
std::string system_name();

/// Sets a variable for this program and its children unless it has a value already.
void set_variable(const char* name, const std::string& value);
/// Closes a connection of this process in children, which would keep its port.
void keep_from_children(std::intptr_t connection);

// The functions below connect a child process. No other child inherits their descriptors; where one fails, `errno` says
// why.

/// Makes a pipe: its reading and its writing end.
bool make_pipe(std::array<int, 2>& ends);
/// Makes a connection: an end for this process and one for a child. A send() to a child that is gone is an error, not a
/// signal.
bool make_connection(std::array<int, 2>& ends);
std::ptrdiff_t send(int end, std::span<const std::uint8_t> bytes);
/// Returns a file without a name, to write and read; -1 if that fails.
int make_nameless_file();
/// A child calls it so that the system kills the child when the thread that started it ends. It does nothing on macOS,
/// and Windows has other means.
void end_with_parent() noexcept;

}  // namespace meniscus::system_process
