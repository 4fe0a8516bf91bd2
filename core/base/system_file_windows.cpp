// SPDX-License-Identifier: BSD-3-Clause
// Implements system_file.h for Windows.
#include <fcntl.h>
#include <io.h>
#include <process.h>
#include <share.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <climits>

#include <windows.h>

#include <aclapi.h>

#include "core/base/system_file.h"

namespace meniscus {

namespace fs = std::filesystem;

// The text is converted from UTF-8 explicitly, because Windows would assume the code page of the machine.
fs::path path_of_text(std::string_view text) { return {std::u8string(text.begin(), text.end())}; }

std::string text_of_path(const fs::path& path) {
  const std::u8string text = path.u8string();
  return {text.begin(), text.end()};
}

namespace system_file {
namespace {

constexpr int kNotInherited = _O_BINARY | _O_NOINHERIT;

// Returns the errno of the C library for an error of Windows.
int errno_of(DWORD error) {
  switch (error) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME:
    case ERROR_BAD_NETPATH:
      return ENOENT;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION:
    case ERROR_LOCK_VIOLATION:
      return EACCES;
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS:
      return EEXIST;
    case ERROR_DISK_FULL:
    case ERROR_HANDLE_DISK_FULL:
      return ENOSPC;
    case ERROR_NOT_SAME_DEVICE:
      return EXDEV;
    case ERROR_NOT_ENOUGH_MEMORY:
      return ENOMEM;
    default:
      return EIO;
  }
}

bool succeeded(BOOL result) {
  if (!result) errno = errno_of(::GetLastError());
  return result != 0;
}

std::uint64_t joined(DWORD high, DWORD low) { return std::uint64_t{high} << 32 | low; }

std::optional<State> state_from(HANDLE handle) {
  State state;
  if (::GetFileType(handle) != FILE_TYPE_DISK) return state;
  BY_HANDLE_FILE_INFORMATION information{};
  if (!succeeded(::GetFileInformationByHandle(handle, &information))) return {};
  state.kind = information.dwFileAttributes & FILE_ATTRIBUTE_REPARSE_POINT ? State::Kind::link
               : information.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY   ? State::Kind::folder
                                                                           : State::Kind::file;
  state.size = joined(information.nFileSizeHigh, information.nFileSizeLow);
  const FILETIME& modified = information.ftLastWriteTime;
  state.modified = static_cast<std::int64_t>(joined(modified.dwHighDateTime, modified.dwLowDateTime) * 100);
  state.identity = {information.dwVolumeSerialNumber, joined(information.nFileIndexHigh, information.nFileIndexLow)};
  return state;
}

std::optional<State> state_from(const fs::path& path, DWORD flags) {
  constexpr DWORD kShared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  const HANDLE handle = ::CreateFileW(path.c_str(), FILE_READ_ATTRIBUTES, kShared, nullptr, OPEN_EXISTING,
                                      FILE_FLAG_BACKUP_SEMANTICS | flags, nullptr);
  if (!succeeded(handle != INVALID_HANDLE_VALUE)) return {};
  const std::optional<State> state = state_from(handle);
  ::CloseHandle(handle);
  return state;
}

HANDLE handle_of(int file) { return reinterpret_cast<HANDLE>(::_get_osfhandle(file)); }

unsigned piece(std::size_t count) { return static_cast<unsigned>(std::min<std::size_t>(count, INT_MAX)); }

OVERLAPPED place(std::uint64_t offset) {
  OVERLAPPED overlapped{};
  overlapped.Offset = static_cast<DWORD>(offset);
  overlapped.OffsetHigh = static_cast<DWORD>(offset >> 32);
  return overlapped;
}

}  // namespace

std::optional<State> state_of(const fs::path& path) { return state_from(path, 0); }
std::optional<State> state_of_entry(const fs::path& path) { return state_from(path, FILE_FLAG_OPEN_REPARSE_POINT); }
std::optional<State> state_of(int file) { return state_from(handle_of(file)); }

bool is_open_to_others(const fs::path& path) {
  constexpr ACCESS_MASK kReadsOrWrites = FILE_READ_DATA | FILE_WRITE_DATA | GENERIC_READ | GENERIC_WRITE | GENERIC_ALL;
  PACL list = nullptr;
  PSECURITY_DESCRIPTOR descriptor = nullptr;
  if (::GetNamedSecurityInfoW(path.c_str(), SE_FILE_OBJECT, DACL_SECURITY_INFORMATION, nullptr, nullptr, &list, nullptr,
                              &descriptor) != ERROR_SUCCESS)
    return false;
  bool is_open = list == nullptr;  // then everybody has all rights
  for (DWORD n = 0; !is_open && n < list->AceCount; ++n) {
    void* entry = nullptr;
    if (!::GetAce(list, n, &entry)) continue;
    const auto* const allowed = static_cast<const ACCESS_ALLOWED_ACE*>(entry);
    if (allowed->Header.AceType != ACCESS_ALLOWED_ACE_TYPE || (allowed->Mask & kReadsOrWrites) == 0) continue;
    const auto whose = reinterpret_cast<PSID>(const_cast<DWORD*>(&allowed->SidStart));
    for (const auto kind : {WinWorldSid, WinAuthenticatedUserSid, WinBuiltinUsersSid})
      is_open = is_open || ::IsWellKnownSid(whose, kind);
  }
  ::LocalFree(descriptor);
  return is_open;
}

int open_to_read(const fs::path& path) { return ::_wopen(path.c_str(), _O_RDONLY | kNotInherited); }

std::FILE* open_plain(const fs::path& path) {
  const std::optional<State> state = state_of_entry(path);
  return state && state->kind == State::Kind::file ? ::_wfopen(path.c_str(), L"rbN") : nullptr;
}

int create(const fs::path& path) {
  return ::_wopen(path.c_str(), _O_WRONLY | _O_CREAT | _O_EXCL | kNotInherited, _S_IREAD | _S_IWRITE);
}

bool close(int file) { return ::_close(file) == 0; }

std::ptrdiff_t read(int file, std::byte* bytes, std::size_t count) {
  ::_setmode(file, _O_BINARY);  // standard input is in text mode otherwise
  return ::_read(file, bytes, piece(count));
}

std::ptrdiff_t read_at(int file, std::byte* bytes, std::size_t count, std::uint64_t offset) {
  OVERLAPPED from = place(offset);
  DWORD got = 0;
  if (!::ReadFile(handle_of(file), bytes, piece(count), &got, &from)) {
    if (::GetLastError() == ERROR_HANDLE_EOF) return 0;
    succeeded(FALSE);
    return -1;
  }
  return static_cast<std::ptrdiff_t>(got);
}

std::ptrdiff_t write(int file, const std::byte* bytes, std::size_t count) {
  return ::_write(file, bytes, piece(count));
}

std::ptrdiff_t write_at(int file, const std::byte* bytes, std::size_t count, std::uint64_t offset) {
  OVERLAPPED to = place(offset);
  DWORD written = 0;
  return succeeded(::WriteFile(handle_of(file), bytes, piece(count), &written, &to))
             ? static_cast<std::ptrdiff_t>(written)
             : -1;
}

bool sync(const fs::path& path) {
  const int file = ::_wopen(path.c_str(), _O_RDWR | kNotInherited);
  if (file < 0) return false;
  const int error = ::_commit(file) != 0 ? errno : 0;
  ::_close(file);
  errno = error;
  return error == 0;
}

// Renames are written through to the disk already.
void sync_folder(const fs::path&) {}

bool rename_to_free(const fs::path& from, const fs::path& to) {
  return succeeded(::MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_WRITE_THROUGH));
}

bool rename_over(const fs::path& from, const fs::path& to) {
  return succeeded(::MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH));
}

void remove(const fs::path& path) noexcept {
  if (!::DeleteFileW(path.c_str())) ::RemoveDirectoryW(path.c_str());
}

void wait_a_millisecond() noexcept { ::Sleep(1); }

int process_id() { return ::_getpid(); }

fs::path program_path() {
  std::array<wchar_t, 32768> path{};  // the longest path of Windows
  const DWORD length = ::GetModuleFileNameW(nullptr, path.data(), static_cast<DWORD>(path.size()));
  return fs::path(path.data(), path.data() + length);
}

}  // namespace system_file
}  // namespace meniscus
