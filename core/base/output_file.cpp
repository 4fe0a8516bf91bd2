// SPDX-License-Identifier: BSD-3-Clause
// Writes files beside their final names, syncs and renames them, and clears away those that were never finished.
#include "core/base/output_file.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <memory>
#include <mutex>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/uninterrupted.h"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::strerror(error); }

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

/// Makes a rename durable; file systems that cannot sync folders (EINVAL) are left to their own order.
void sync_folder(const fs::path& folder) {
  const int descriptor = uninterrupted([&] { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
  if (descriptor < 0) return;
  uninterrupted([&] { return ::fsync(descriptor); });
  ::close(descriptor);
}

/// Gives the file a name that nobody has, even if somebody takes it at this moment. Otherwise false, and why in errno.
bool rename_to_free(const fs::path& from, const fs::path& to) {
  const auto rename = [&] { return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE); };
  if (uninterrupted(rename) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS) return false;
  // File systems without it, such as NFS, have links, which do not replace either.
  if (uninterrupted([&] { return ::link(from.c_str(), to.c_str()); }) == 0) {
    ::unlink(from.c_str());
    return true;
  }
  const bool no_links = errno == EPERM || errno == EOPNOTSUPP || errno == ENOSYS;
  return no_links && uninterrupted([&] { return ::rename(from.c_str(), to.c_str()); }) == 0;
}

/// The files that protect_input() was told of, by device and inode.
class Inputs {
 public:
  void add(const struct stat& status) {
    const std::lock_guard lock(mutex_);
    files_.emplace(status.st_dev, status.st_ino);
  }
  bool has(const struct stat& status) {
    const std::lock_guard lock(mutex_);
    return files_.contains({status.st_dev, status.st_ino});
  }

 private:
  std::mutex mutex_;
  std::set<std::pair<dev_t, ino_t>> files_;
};

Inputs& inputs() {
  static Inputs all;
  return all;
}

void refuse_unsuitable_target(const fs::path& target, Existing existing) {
  if (target.filename().empty()) throw OutputError(target.string(), "names no file");
  struct stat status {};
  if (::stat(target.c_str(), &status) == 0 && inputs().has(status))
    throw OutputError(target.string(), "is one of the files that this command reads; choose another name");
  if (::lstat(target.c_str(), &status) != 0) return;
  if (S_ISDIR(status.st_mode)) throw OutputError(target.string(), "is a folder; give the name of a file");
  if (!S_ISREG(status.st_mode) && !S_ISLNK(status.st_mode)) throw OutputError(target.string(), "is no regular file");
  if (existing == Existing::refuse) throw OutputError(target.string(), "exists already; use --force to replace it");
}

/// Temporary files of this process that have not got their final name, and folders made for them, newest first. What
/// is done under the lock needs no memory and no other lock, so that a signal handler may go through them.
class Unfinished {
 public:
  void add(const fs::path& path) {
    auto entry = std::make_unique<Entry>(Entry{path, nullptr});
    lock();
    entry->older = newest_;
    newest_ = entry.release();
    unlock();
  }
  void remove(const fs::path& path) noexcept {
    lock();
    Entry** place = &newest_;
    while (*place && (*place)->path.native() != path.native()) place = &(*place)->older;
    const std::unique_ptr<Entry> found(*place);
    if (found) *place = found->older;
    unlock();
  }
  /// Files go before the folder they are in, for it is older; a folder that others use meanwhile stays.
  void unlink_all() noexcept {
    // The program may be ending because of an error under this very lock.
    constexpr int kMostWaits = 1000;
    for (int waits = 0; locked_.test_and_set(std::memory_order_acquire); ++waits) {
      if (waits == kMostWaits) return;
      const timespec millisecond{0, 1'000'000};
      ::nanosleep(&millisecond, nullptr);
    }
    for (const Entry* entry = newest_; entry; entry = entry->older)
      if (::unlink(entry->path.c_str()) != 0) ::rmdir(entry->path.c_str());
    unlock();
  }

 private:
  struct Entry {
    fs::path path;
    Entry* older;
  };

  void lock() noexcept {
    while (locked_.test_and_set(std::memory_order_acquire)) ::sched_yield();
  }
  void unlock() noexcept { locked_.clear(std::memory_order_release); }

  std::atomic_flag locked_;
  Entry* newest_ = nullptr;
};

constinit Unfinished unfinished;

}  // namespace

void remove_unfinished_outputs() noexcept { unfinished.unlink_all(); }

OutputFile::OutputFile(fs::path target, Existing existing) : target_(std::move(target)), existing_(existing) {
  refuse_unsuitable_target(target_, existing_);
  static std::atomic<unsigned> serial{0};
  // Our own exclusive name instead of mkstemp: mkstemp's mode 0600 would outlive the rename.
  for (int attempt = 0; descriptor_ < 0 && attempt < 1000; ++attempt) {
    temporary_ = folder_of(target_) / fmt::format(".{}.{}-{}.part{}", target_.stem().string(), ::getpid(), serial++,
                                                  target_.extension().string());
    descriptor_ = uninterrupted(
        [&] { return ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666); });
    if (descriptor_ < 0 && errno != EEXIST) break;
  }
  if (descriptor_ < 0) {
    const int error = errno;
    temporary_.clear();
    fail(fmt::format("cannot be written in {}: {}", folder_of(target_).string(), reason(error)));
  }
  try {
    unfinished.add(temporary_);
  } catch (...) {
    ::close(descriptor_);
    ::unlink(temporary_.c_str());
    throw;
  }
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (temporary_.empty()) return;
  ::unlink(temporary_.c_str());
  unfinished.remove(temporary_);
}

void OutputFile::write(std::string_view text) { write(std::as_bytes(std::span(text))); }

void OutputFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = uninterrupted([&] { return ::write(descriptor_, bytes.data(), bytes.size()); });
    if (written <= 0) fail("cannot be written: " + reason(written < 0 ? errno : ENOSPC));
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void OutputFile::rewrite_beginning(std::span<const std::byte> bytes) {
  for (off_t at = 0; !bytes.empty();) {
    const ssize_t written = uninterrupted([&] { return ::pwrite(descriptor_, bytes.data(), bytes.size(), at); });
    if (written <= 0) fail("cannot be written: " + reason(written < 0 ? errno : ENOSPC));
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    at += written;
  }
}

void OutputFile::sync() {
  // A descriptor is closed even where that is interrupted, and what matters is the sync.
  if (descriptor_ >= 0 && ::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR)
    fail("cannot be written: " + reason(errno));
  // A program may have replaced the temporary file by name, so the name is synced, not our descriptor.
  const int descriptor = uninterrupted([&] { return ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC); });
  if (descriptor < 0) fail("vanished while it was written: " + reason(errno));
  const int error = uninterrupted([&] { return ::fsync(descriptor); }) != 0 ? errno : 0;
  ::close(descriptor);
  if (error != 0 && error != EINVAL) fail("cannot be written: " + reason(error));
}

void OutputFile::rename_to_target() {
  struct stat status {};
  replaced_ = ::lstat(target_.c_str(), &status) == 0;
  if (existing_ == Existing::refuse) {
    refuse_unsuitable_target(target_, existing_);
    if (!rename_to_free(temporary_, target_)) {
      const int error = errno;
      refuse_unsuitable_target(target_, existing_);
      fail("cannot get its final name: " + reason(error));
    }
  } else if (uninterrupted([&] { return ::rename(temporary_.c_str(), target_.c_str()); }) != 0) {
    fail("cannot get its final name: " + reason(errno));
  }
  unfinished.remove(temporary_);
  temporary_.clear();
}

void OutputFile::commit() {
  const fs::path folder = folder_of(target_);  // nothing may fail once the file has its name
  sync();
  rename_to_target();
  sync_folder(folder);
}

void OutputFile::fail(const std::string& what) const { throw OutputError(target_.string(), what); }

void protect_input(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode)) inputs().add(status);
}

void make_folders_of(const fs::path& file) {
  std::error_code error;
  fs::create_directories(folder_of(file), error);
  if (error) throw OutputError(folder_of(file).string(), "the folder cannot be made: " + error.message());
}

void check_output(const fs::path& target, Existing existing) { const OutputFile possible(target, existing); }

OutputFolder::OutputFolder(fs::path folder, Existing existing) : folder_(std::move(folder)), existing_(existing) {
  if (folder_.empty()) throw OutputError("output folder", "the name is empty");
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path path = folder_; !path.empty() && fs::symlink_status(path, error).type() == fs::file_type::not_found;
       path = path.parent_path()) {
    if (path.has_filename()) missing.push_back(path);
  }
  std::reverse(missing.begin(), missing.end());
  try {
    created_folders_.reserve(missing.size());
    for (fs::path& path : missing) {
      if (fs::create_directory(path, error)) unfinished.add(created_folders_.emplace_back(std::move(path)));
      if (error) break;
    }
  } catch (...) {
    remove_created_folders();
    throw;
  }
  if (std::error_code ignored; !fs::is_directory(folder_, ignored)) {
    remove_created_folders();
    throw OutputError(folder_.string(), "is no folder and cannot be made one" + (error ? ": " + error.message() : ""));
  }
}

OutputFolder::~OutputFolder() {
  files_.clear();
  if (committed_) {
    for (const fs::path& path : created_folders_) unfinished.remove(path);
  } else {
    remove_created_folders();
  }
}

void OutputFolder::remove_created_folders() {
  for (auto made = created_folders_.rbegin(); made != created_folders_.rend(); ++made) {
    ::rmdir(made->c_str());
    unfinished.remove(*made);
  }
}

OutputFile& OutputFolder::file(const std::string& name) {
  if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos) {
    throw OutputError((folder_ / name).string(), "is no plain file name");
  }
  return *files_.emplace_back(std::make_unique<OutputFile>(folder_ / name, existing_));
}

void OutputFolder::commit() {
  for (const auto& file : files_) file->sync();
  std::size_t renamed = 0;
  try {
    for (; renamed < files_.size(); ++renamed) files_[renamed]->rename_to_target();
  } catch (...) {
    for (std::size_t n = 0; n < renamed; ++n) {
      if (!files_[n]->replaced_) ::unlink(files_[n]->target_.c_str());
    }
    throw;
  }
  sync_folder(folder_);
  committed_ = true;
}

void write_shared_files(const std::filesystem::path& folder, Existing existing, std::span<const SharedFile> files) {
  const auto is_there = [&](const SharedFile& shared) {
    std::ifstream file(folder / shared.name, std::ios::binary);
    return file && std::string(std::istreambuf_iterator<char>(file), {}) == shared.text;
  };
  try {
    OutputFolder output(folder, existing);
    for (const SharedFile& shared : files)
      if (!is_there(shared)) output.file(shared.name).write(shared.text);
    output.commit();
  } catch (const OutputError&) {
    if (!std::ranges::all_of(files, is_there)) throw;  // else another process was faster
  }
}

}  // namespace meniscus
