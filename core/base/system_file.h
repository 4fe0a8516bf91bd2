// SPDX-License-Identifier: BSD-3-Clause
// Files as the operating system has them; system_file_posix.cpp (Linux, macOS) and system_file_windows.cpp implement
// the functions.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace meniscus {

/// Returns the result of `call`, which returns a negative number and sets errno if it fails. It is called again as long
/// as a signal interrupts it before it does anything (EINTR). close() must not be called this way, because it closes
/// the file even if interrupted.
template <typename Call>
auto uninterrupted(const Call& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

/// Convert between UTF-8, which all texts of Meniscus use, and paths of the operating system.
std::filesystem::path path_of_text(std::string_view text);
std::string text_of_path(const std::filesystem::path& path);

/// System calls on files. If one of these functions fails, `errno` has the reason.
namespace system_file {

struct State {
  enum class Kind { file, folder, link, other } kind = Kind::other;
  std::uint64_t size = 0;     ///< in bytes
  std::int64_t modified = 0;  ///< in nanoseconds since 1970 (1601 on Windows), for comparing only
  std::pair<std::uint64_t, std::uint64_t> identity;  ///< the same for all names of one file
};

/// Returns the state of the file at a path. A link is followed. Returns nothing if that fails.
std::optional<State> state_of(const std::filesystem::path& path);
/// Returns the state of the file or link at a path. A link is not followed. Returns nothing if that fails.
std::optional<State> state_of_entry(const std::filesystem::path& path);
/// Returns the state of an open file. Returns nothing if that fails.
std::optional<State> state_of(int file);

/// True if users who are not named in the rights to a file can read or write it, as one of its group (not on Windows)
/// or as everybody. False if the file is missing.
bool is_open_to_others(const std::filesystem::path& path);

/// Opens a file for reading and returns its descriptor, or -1. No child process inherits it.
int open_to_read(const std::filesystem::path& path);
/// Opens a file for reading as a stream of bytes. Returns null for a link, a folder and all that is no plain file.
std::FILE* open_plain(const std::filesystem::path& path);
/// Creates a file for writing and returns its descriptor, or -1. Fails if there is a file or link of this name already.
int create(const std::filesystem::path& path);
/// Closes a file. False if the system reports that some bytes were not written.
bool close(int file);

/// Each of these reads or writes at most `count` bytes and returns how many, 0 at the end of a file, and -1 for an
/// error. The first and the third go on from the file's current position.
std::ptrdiff_t read(int file, std::byte* bytes, std::size_t count);
std::ptrdiff_t read_at(int file, std::byte* bytes, std::size_t count, std::uint64_t offset);
std::ptrdiff_t write(int file, const std::byte* bytes, std::size_t count);
std::ptrdiff_t write_at(int file, const std::byte* bytes, std::size_t count, std::uint64_t offset);

/// Writes all bytes of the file to the disk, including those that another program wrote. True if that succeeds, and on
/// file systems that have no such request.
bool sync(const std::filesystem::path& path);
/// Makes a rename in this folder durable, as far as the file system can.
void sync_folder(const std::filesystem::path& folder);

/// Renames a file. False if `to` exists, even if another process creates it at this moment.
bool rename_to_free(const std::filesystem::path& from, const std::filesystem::path& to);
/// Renames a file. A file at `to` is replaced atomically.
bool rename_over(const std::filesystem::path& from, const std::filesystem::path& to);

/// Removes a file, a link or an empty folder. It allocates no memory, so that a signal handler may call it.
void remove(const std::filesystem::path& path) noexcept;
/// Waits for a millisecond. A signal handler may call it.
void wait_a_millisecond() noexcept;

int process_id();
/// Returns the path of the running program; empty if the system does not have it.
std::filesystem::path program_path();

}  // namespace system_file
}  // namespace meniscus
