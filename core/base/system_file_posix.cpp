// SPDX-License-Identifier: BSD-3-Clause
// Implements system_file.h for Linux and macOS.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#if defined(__APPLE__)
#include <mach-o/dyld.h>
#endif

#include <array>
#include <ctime>

#include "core/base/system_file.h"

namespace meniscus {

namespace fs = std::filesystem;

fs::path path_of_text(std::string_view text) { return {text}; }
std::string text_of_path(const fs::path& path) { return path.string(); }

namespace system_file {
namespace {

State state_from(const struct stat& status) {
  State state;
  state.kind = S_ISREG(status.st_mode)   ? State::Kind::file
               : S_ISDIR(status.st_mode) ? State::Kind::folder
               : S_ISLNK(status.st_mode) ? State::Kind::link
                                         : State::Kind::other;
  state.size = static_cast<std::uint64_t>(status.st_size);
#if defined(__APPLE__)
  const timespec& modified = status.st_mtimespec;
#else
  const timespec& modified = status.st_mtim;
#endif
  state.modified = std::int64_t{modified.tv_sec} * 1'000'000'000 + modified.tv_nsec;
  state.identity = {static_cast<std::uint64_t>(status.st_dev), static_cast<std::uint64_t>(status.st_ino)};
  return state;
}

// Renames a file and returns 0 if `to` did not exist. Otherwise returns -1, with EINVAL or ENOSYS where the file system
// has no such request.
int rename_exclusively(const char* from, const char* to) {
#if defined(__APPLE__)
  const int result = ::renamex_np(from, to, RENAME_EXCL);
  if (result != 0 && errno == ENOTSUP) errno = EINVAL;
  return result;
#else
  return ::renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE);
#endif
}

}  // namespace

std::optional<State> state_of(const fs::path& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? std::optional(state_from(status)) : std::nullopt;
}

std::optional<State> state_of_entry(const fs::path& path) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 ? std::optional(state_from(status)) : std::nullopt;
}

std::optional<State> state_of(int file) {
  struct stat status {};
  return ::fstat(file, &status) == 0 ? std::optional(state_from(status)) : std::nullopt;
}

bool is_open_to_others(const fs::path& path) {
  using enum fs::perms;
  std::error_code missing;
  const fs::perms rights = fs::status(path, missing).permissions();
  return !missing && (rights & (group_all | others_all)) != none;
}

int open_to_read(const fs::path& path) {
  return uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC); });
}

std::FILE* open_plain(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  const std::optional<State> state = file < 0 ? std::nullopt : state_of(file);
  if (state && state->kind == State::Kind::file) return ::fdopen(file, "rb");
  if (file >= 0) ::close(file);
  return nullptr;
}

int create(const fs::path& path) {
  return uninterrupted(
      [&] { return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666); });
}

// The descriptor is closed even if the call is interrupted.
bool close(int file) { return ::close(file) == 0 || errno == EINTR; }

std::ptrdiff_t read(int file, std::byte* bytes, std::size_t count) {
  return uninterrupted([&] { return ::read(file, bytes, count); });
}

std::ptrdiff_t read_at(int file, std::byte* bytes, std::size_t count, std::uint64_t offset) {
  return uninterrupted([&] { return ::pread(file, bytes, count, static_cast<off_t>(offset)); });
}

std::ptrdiff_t write(int file, const std::byte* bytes, std::size_t count) {
  return uninterrupted([&] { return ::write(file, bytes, count); });
}

std::ptrdiff_t write_at(int file, const std::byte* bytes, std::size_t count, std::uint64_t offset) {
  return uninterrupted([&] { return ::pwrite(file, bytes, count, static_cast<off_t>(offset)); });
}

bool sync(const fs::path& path) {
  const int file = open_to_read(path);
  if (file < 0) return false;
  const int error = uninterrupted([&] { return ::fsync(file); }) != 0 ? errno : 0;
  ::close(file);
  errno = error;
  return error == 0 || error == EINVAL;
}

void sync_folder(const fs::path& folder) {
  const int file = uninterrupted([&] { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
  if (file < 0) return;
  uninterrupted([&] { return ::fsync(file); });
  ::close(file);
}

bool rename_to_free(const fs::path& from, const fs::path& to) {
  if (uninterrupted([&] { return rename_exclusively(from.c_str(), to.c_str()); }) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS) return false;
  // File systems without this request, such as NFS, have hard links, which never replace a file.
  if (uninterrupted([&] { return ::link(from.c_str(), to.c_str()); }) == 0) {
    ::unlink(from.c_str());
    return true;
  }
  const bool no_links = errno == EPERM || errno == EOPNOTSUPP || errno == ENOSYS;
  return no_links && rename_over(from, to);
}

bool rename_over(const fs::path& from, const fs::path& to) {
  return uninterrupted([&] { return ::rename(from.c_str(), to.c_str()); }) == 0;
}

void remove(const fs::path& path) noexcept {
  if (::unlink(path.c_str()) != 0) ::rmdir(path.c_str());
}

void wait_a_millisecond() noexcept {
  const timespec millisecond{0, 1'000'000};
  ::nanosleep(&millisecond, nullptr);
}

int process_id() { return ::getpid(); }

fs::path program_path() {
  std::error_code none;
#if defined(__APPLE__)
  std::array<char, 4096> path{};
  std::uint32_t size = path.size();
  return ::_NSGetExecutablePath(path.data(), &size) == 0 ? fs::canonical(path.data(), none) : fs::path();
#else
  return fs::read_symlink("/proc/self/exe", none);
#endif
}

}  // namespace system_file
}  // namespace meniscus
