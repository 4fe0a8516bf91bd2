// SPDX-License-Identifier: BSD-3-Clause
// Functions of the operating system for this process, implemented by system_process_posix.cpp (Linux, macOS) and
// system_process_windows.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>

namespace meniscus::system_process {

/// Returns the words that main() got, in UTF-8, beginning with the program's. They live as long as the program.
std::span<const char* const> words(int argc, char** argv);

/// Gives a closed standard stream a descriptor that cannot be read from or written to. Otherwise the next file that is
/// opened would take its number, and messages would be written into it. Printed text gets the same bytes on every
/// system.
void hold_standard_streams();
/// Returns true if text that is printed to this stream appears on a terminal.
bool is_terminal(std::FILE* stream);
/// Writes a line on standard error. It needs no memory, so that a signal handler may call it.
void write_error(std::string_view line) noexcept;
/// Ends the program without its destructors. A signal handler may call it, too.
[[noreturn]] void end(int code) noexcept;

/// Watch libraries under a limit of memory, which they do not survive; see program_main.h.
bool memory_is_limited();
void libraries_are_loaded();
/// Returns the memory of the machine, in bytes.
std::uint64_t physical_memory();

/// Calls `stopped` with the number of the first of SIGINT, SIGTERM, SIGHUP and SIGUSR1, or of a similar event of
/// Windows, on a separate thread. Also makes a file that gets too large an error of write(). Must be called once,
/// before other threads are started. Throws CapacityError.
void await_stop(void (*stopped)(int signal));

/// Makes a write to a pipe or a connection without a reader an error, not a signal, from now on.
void outlive_readers();

/// Processor time that the program has used, in seconds.
struct ProcessorTime {
  double user = 0, system = 0;
};
ProcessorTime processor_time();

/// Returns the name of this machine; empty if it has none.
std::string host();
/// Returns the system, its version and its processor, such as "Linux 6.1.0 x86_64, glibc 2.36".
std::string system_name();

/// Sets a variable for this program and its children unless it has a value already.
void set_variable(const char* name, const std::string& value);
/// Closes a connection of this process in children, which would otherwise keep its port.
void keep_from_children(std::intptr_t connection);

// The functions below connect one child process. If one fails, `errno` has the reason.

/// Makes a pipe, with its reading and its writing end.
bool make_pipe(std::array<int, 2>& ends);
/// Makes a connection to a child: this end, its end. A send() to a child that has ended is an error, not a signal.
bool make_connection(std::array<int, 2>& ends);
std::ptrdiff_t send(int end, std::span<const std::uint8_t> bytes);
/// Returns a file without a name for writing and reading; -1 if that fails.
int make_nameless_file();
/// Makes the system kill this child when the thread that started it ends; does nothing on macOS and Windows.
void end_with_parent() noexcept;

}  // namespace meniscus::system_process
