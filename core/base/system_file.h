// SPDX-License-Identifier: BSD-3-Clause
// Files as the operating system has them: system_file_posix.cpp (Linux, macOS) and system_file_windows.cpp implement
// it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace meniscus {

/// The path that a text in UTF-8 names, which texts are everywhere in Meniscus; and the text of a path.
std::filesystem::path path_of_text(std::string_view text);
std::string text_of_path(const std::filesystem::path& path);

/// Where a function below fails, `errno` says why.
namespace system_file {

struct State {
  enum class Kind { file, folder, link, other } kind = Kind::other;
  std::uint64_t size = 0;                            ///< in bytes
  std::int64_t modified = 0;                         ///< nanoseconds since 1970 (or 1601 on Windows), for comparing
  std::pair<std::uint64_t, std::uint64_t> identity;  ///< the same for all names of a file
};

/// Of what is there under this name, or of what a link there leads to. Nothing if that fails.
std::optional<State> state_of(const std::filesystem::path& path);
/// The same, but of a link itself.
std::optional<State> state_of_entry(const std::filesystem::path& path);
std::optional<State> state_of(int file);

/// The number of an open file, -1 if that fails. No child process inherits it.
int open_to_read(const std::filesystem::path& path);
/// Makes a file to write into; fails where there is something already, be it a link.
int create(const std::filesystem::path& path);
/// Closes it; false where that says that something was not written.
bool close(int file);

/// Bytes read or written, which may be fewer; none at the end of the file, -1 if that fails.
std::ptrdiff_t read(int file, std::byte* bytes, std::size_t count);
std::ptrdiff_t read_at(int file, std::byte* bytes, std::size_t count, std::uint64_t offset);
std::ptrdiff_t write(int file, const std::byte* bytes, std::size_t count);
std::ptrdiff_t write_at(int file, const std::byte* bytes, std::size_t count, std::uint64_t offset);

/// Writes all bytes of the file to the disk, also those that another program wrote. True as well on file systems that
/// have no such request.
bool sync(const std::filesystem::path& path);
/// Makes a rename durable, as far as the file system can.
void sync_folder(const std::filesystem::path& folder);

/// Gives a file another name, under which nothing may be, even if someone takes it at this moment.
bool rename_to_free(const std::filesystem::path& from, const std::filesystem::path& to);
/// Gives a file another name; what is there is replaced at once.
bool rename_over(const std::filesystem::path& from, const std::filesystem::path& to);

/// Removes a file or link, or an empty folder. Needs no memory, so that a signal handler may call it.
void remove(const std::filesystem::path& path) noexcept;
/// Waits a moment, also in a signal handler.
void wait_a_millisecond() noexcept;

/// The number of this process, and the file of its program, empty where the system does not tell.
int process();
std::filesystem::path program();

}  // namespace system_file
}  // namespace meniscus
